#include "common/sha256.hpp"

#include <glib.h>

namespace dipper {

std::string sha256(std::string_view bytes) {
  gchar* hex = g_compute_checksum_for_data(
      G_CHECKSUM_SHA256, reinterpret_cast<const guchar*>(bytes.data()), bytes.size());
  std::string digest = hex;
  g_free(hex);
  return digest;
}

}  // namespace dipper
