#include "analysis/report/packing.hpp"

#include <zlib.h>

#include <array>
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
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::array<std::uint32_t, 3> b{};
    for (std::size_t k = 0; k < n; ++k) b[k] = bytes[i + k];
    const std::uint32_t word = b[0] << 16 | b[1] << 8 | b[2];
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= n ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace dipper::analysis::report
