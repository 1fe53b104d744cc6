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

std::string hmac_sha256(std::string_view key, std::string_view bytes) {
  const std::unique_ptr<GHmac, void (*)(GHmac*)> hmac(
      g_hmac_new(G_CHECKSUM_SHA256, bytes_of(key.data()), key.size()), &g_hmac_unref);
  g_hmac_update(hmac.get(), bytes_of(bytes.data()), static_cast<gssize>(bytes.size()));
  std::string digest(32, '\0');
  gsize size = digest.size();
  g_hmac_get_digest(hmac.get(), reinterpret_cast<guint8*>(digest.data()), &size);
  return digest;
}

}  // namespace dipper
