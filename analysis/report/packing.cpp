#include "analysis/report/packing.hpp"

#include <glib.h>
#include <zlib.h>

#include <memory>
#include <stdexcept>

namespace dipper::analysis::report {

std::vector<std::uint8_t> gzip(const std::uint8_t* data, std::size_t size) {
  constexpr int kGzipFormat = 16 + MAX_WBITS;  // zlib.h: 16 asks for a gzip header
  constexpr int kMemory = 9;                   // the most zlib takes, 512 kB
  z_stream z{};
  if (deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipFormat, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("report: zlib does not start");
  }
  std::vector<std::uint8_t> out(deflateBound(&z, size));
  z.next_in = const_cast<Bytef*>(data);
  z.avail_in = static_cast<uInt>(size);
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  const int end = deflate(&z, Z_FINISH);
  out.resize(z.total_out);
  deflateEnd(&z);
  if (end != Z_STREAM_END) throw std::runtime_error("report: zlib does not compress");
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(g_base64_encode(bytes.data(), bytes.size()),
                                                       &g_free);
  return text.get();
}

}  // namespace dipper::analysis::report
