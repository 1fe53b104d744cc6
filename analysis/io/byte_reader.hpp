// Bytes and words of a large file that mixes text and binary data.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct gzFile_s;  // of zlib.h

namespace dipper::analysis::io {

/// Reads a file, gzipped or not, in a buffer of fixed size; counts lines as long as it is read as
/// text; skips a byte-order mark of UTF-8. Throws InputError when the file cannot be read.
class ByteReader {
 public:
  explicit ByteReader(std::filesystem::path file, std::int64_t offset = 0, long line = 1);

  static constexpr int kEnd = -1;
  int peek() { return read_ < filled_ || refill() ? byte() : kEnd; }
  int get() {
    const int c = peek();
    if (c != kEnd) ++read_;
    if (c == '\n') ++line_;
    return c;
  }

  /// The next word: up to white space or '<'; empty at the end of the file, or in front of a '<'.
  void word(std::string& out);
  /// The rest of the line, without its newline.
  std::string rest_of_line();
  /// Whether the next bytes are these; does not consume them. At most 16.
  bool next_is(const char* text);
  /// Raw bytes; false when the file ends first.
  bool bytes(char* out, std::size_t n);
  bool skip(std::int64_t n);

  std::int64_t offset() const { return base_ + static_cast<std::int64_t>(read_); }
  long line() const { return line_; }
  const std::filesystem::path& file() const { return file_; }

 protected:
  bool refill();  ///< discards consumed bytes; the buffer grows when there are none

  std::vector<char> buffer_;
  std::size_t read_ = 0, filled_ = 0;  // in buffer_
  long line_ = 1;

 private:
  int byte() const { return static_cast<unsigned char>(buffer_[read_]); }
  std::filesystem::path file_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> stream_;
  std::int64_t base_ = 0;  // offset of buffer_[0] in the file, uncompressed
};

}  // namespace dipper::analysis::io
