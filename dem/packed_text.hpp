// Text that several ranks pack, each its own part, into one gzip file.
#pragma once

#include <cstdint>
#include <string>

namespace dipper::dem {

/// A part of a file's text, deflated without reference to any other part.
struct PackedText {
  std::string bytes;
  std::uint64_t length = 0;  ///< of the text
  std::uint32_t crc = 0;
};

/// Throws std::bad_alloc.
PackedText pack_text(const std::string& text);

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
