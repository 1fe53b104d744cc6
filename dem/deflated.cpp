#include "dem/deflated.hpp"

#include <zlib.h>

#include <new>
#include <stdexcept>

namespace dipper::dem {
namespace {

constexpr int kRawDeflate = -15;  // with a window of 2^15 bytes
constexpr int kMemory = 8;        // zlib's default

void put_u32(std::uint32_t value, std::string& to) {
  for (int byte = 0; byte < 4; ++byte)
    to.push_back(static_cast<char>(static_cast<unsigned char>(value >> (8 * byte))));
}

const Bytef* bytes_of(const std::string& text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

Deflated deflated(const std::string& text, int level) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, kRawDeflate, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  Deflated out;
  // A flush ends on a whole byte, so that another part can follow; it takes 5 bytes.
  out.bytes.resize(deflateBound(&stream, static_cast<uLong>(text.size())) + 16);
  stream.next_in = const_cast<Bytef*>(bytes_of(text));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.bytes.data());
  stream.avail_out = static_cast<uInt>(out.bytes.size());
  deflate(&stream, Z_SYNC_FLUSH);
  out.bytes.resize(stream.total_out);
  deflateEnd(&stream);
  out.length = text.size();
  out.crc = static_cast<std::uint32_t>(crc32_z(0, bytes_of(text), text.size()));
  return out;
}

std::string inflated(const Deflated& part) {
  z_stream stream{};
  if (inflateInit2(&stream, kRawDeflate) != Z_OK) throw std::bad_alloc();
  std::string out(part.length + 1, '\0');  // one byte more, so that zlib also reads the final flush
  stream.next_in = const_cast<Bytef*>(bytes_of(part.bytes));
  stream.avail_in = static_cast<uInt>(part.bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_SYNC_FLUSH);
  const bool whole = stream.total_out == part.length && stream.avail_in == 0;
  inflateEnd(&stream);
  out.pop_back();
  if (!whole || crc32_z(0, bytes_of(out), out.size()) != part.crc)
    throw std::runtime_error("it is damaged");
  return out;
}

std::string gzip_head() { return {"\x1f\x8b\x08\0\0\0\0\0\0\x03", 10}; }

void GzipTail::add(std::uint64_t length, std::uint32_t crc) {
  crc_ = static_cast<std::uint32_t>(crc32_combine(crc_, crc, static_cast<z_off_t>(length)));
  length_ += length;
}

std::string GzipTail::bytes() const {
  std::string out{"\x03\0", 2};  // the last block, empty
  put_u32(crc_, out);
  put_u32(static_cast<std::uint32_t>(length_), out);  // modulo 2^32
  return out;
}

}  // namespace dipper::dem
