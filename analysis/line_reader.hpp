// Lines of a large text file, with their numbers.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "coupler/motion/input_error.hpp"

namespace dipper {

/// "FILE:LINE: MESSAGE", or "FILE: MESSAGE" with line 0.
InputError input_error(const std::filesystem::path& file, long line, const std::string& message);

/// Reads a file line by line in a buffer of fixed size (it grows only for a longer line). Throws
/// InputError when the file cannot be read.
class LineReader {
 public:
  /// From byte `offset`, which is the start of line `line` (1-based).
  explicit LineReader(std::filesystem::path file, std::int64_t offset = 0, long line = 1);

  /// The next line without its end; valid until the next call. False at the end of the file.
  bool next(std::string_view& text);

  long line() const { return line_ - 1; }                ///< number of the last line given
  std::int64_t offset() const { return base_ + read_; }  ///< of the line that comes next
  bool ended_whole() const { return ended_whole_; }      ///< the last line had its newline
  const std::filesystem::path& file() const { return file_; }

 private:
  bool refill();
  std::filesystem::path file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
  std::vector<char> buffer_;
  std::size_t read_ = 0, filled_ = 0;  // in buffer_
  std::int64_t base_ = 0;              // offset of buffer_[0] in the file
  long line_ = 1;
  bool ended_whole_ = true;
};

/// Opens a file for reading in binary; throws InputError.
std::unique_ptr<std::FILE, int (*)(std::FILE*)> open_file(const std::filesystem::path& file);

/// Takes the next word (up to blank, tab or carriage return) off the front; empty: none left.
std::string_view take_word(std::string_view& text);

/// All of a word as a number; false when it is none or not finite.
bool parse_number(std::string_view word, double& value);
bool parse_number(std::string_view word, std::int64_t& value);

}  // namespace dipper
