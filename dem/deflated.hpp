// Bytes deflated by rank: parts of one gzip file, or of an image.
#pragma once

#include <cstdint>
#include <string>

namespace dipper::dem {

/// A part of a file, deflated without reference to any other part.
struct Deflated {
  std::string bytes;
  std::uint64_t length = 0;  ///< of what it was made of
  std::uint32_t crc = 0;     ///< likewise
};

/// \param level  zlib's, 1 (fastest) to 9. Throws std::bad_alloc.
Deflated deflated(const std::string& bytes, int level);

/// What it was made of. Throws std::runtime_error when it is not what `deflated` made.
std::string inflated(const Deflated& part);

/// What stands before the first part in a gzip file (RFC 1952). Parts stand one after the other in
/// a single member: not every reader goes on to a second one.
std::string gzip_head();

/// What stands behind the last part, of all parts together.
class GzipTail {
 public:
  void add(std::uint64_t length, std::uint32_t crc);
  std::string bytes() const;

 private:
  std::uint64_t length_ = 0;
  std::uint32_t crc_ = 0;
};

}  // namespace dipper::dem
