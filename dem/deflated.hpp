// Bytes deflated by rank: parts of one gzip file, or of an image.
#pragma once

#include <cstdint>
#include <string>

namespace dipper::dem {

/// A part of a file, deflated without reference to any other part.
struct Deflated {
  std::string bytes;
  std::uint64_t length = 0;  ///< of the inflated bytes
  std::uint32_t crc = 0;     ///< of the inflated bytes
};

/// \param level  zlib's, 1 (fastest) to 9. Throws std::bad_alloc.
Deflated deflated(const std::string& bytes, int level);

/// The inflated bytes. Throws std::runtime_error when they do not agree with length and crc.
std::string inflated(const Deflated& part);

/// The header of a gzip file (RFC 1952), before the first part. All parts form a single member: not
/// every reader continues with a second one.
std::string gzip_head();

/// The trailer of a gzip file, after the last part: CRC and length of all parts.
class GzipTail {
 public:
  void add(std::uint64_t length, std::uint32_t crc);
  std::string bytes() const;

 private:
  std::uint64_t length_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace dipper::dem
