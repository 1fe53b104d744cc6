#include "common/sha256.hpp"

#include <glib.h>

#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace dipper {
namespace {

const guchar* bytes_of(const char* text) { return reinterpret_cast<const guchar*>(text); }

}  // namespace

std::string sha256(std::string_view bytes) {
  gchar* hex = g_compute_checksum_for_data(G_CHECKSUM_SHA256, bytes_of(bytes.data()), bytes.size());
  std::string digest = hex;
  g_free(hex);
  return digest;
}

std::string sha256_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::unique_ptr<GChecksum, void (*)(GChecksum*)> sum(g_checksum_new(G_CHECKSUM_SHA256),
                                                             &g_checksum_free);
  std::array<char, 1 << 16> block{};
  while (in && !std::filesystem::is_directory(file)) {
    in.read(block.data(), block.size());
    g_checksum_update(sum.get(), bytes_of(block.data()), static_cast<gssize>(in.gcount()));
  }
  if (!in.eof()) throw std::runtime_error("cannot read " + file.string());
  return g_checksum_get_string(sum.get());
}

}  // namespace dipper
