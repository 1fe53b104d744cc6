// Lines of a large text file, with their numbers.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "analysis/io/byte_reader.hpp"
#include "common/input_error.hpp"
#include "common/numbers.hpp"

namespace dipper::analysis::io {

/// "FILE:LINE: MESSAGE", or "FILE: MESSAGE" with line 0.
InputError input_error(const std::filesystem::path& file, long line, const std::string& message);

/// Reads a file line by line; the buffer grows for longer lines. Throws InputError when the file
/// cannot be read.
class LineReader : private ByteReader {
 public:
  using ByteReader::ByteReader;  // `offset` is the start of line `line` (1-based)
  using ByteReader::file;
  using ByteReader::offset;  // of the next line

  /// The next line without its newline; valid until the next call. False at the end of the file.
  bool next(std::string_view& text);

  long line() const { return line_ - 1; }            ///< number of the last line returned
  bool ended_whole() const { return ended_whole_; }  ///< the last line had its newline

 private:
  bool ended_whole_ = true;
};

/// Opens a file, gzipped or not, for reading; throws InputError.
std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> open_file(const std::filesystem::path& file);

/// Removes and returns the next word (up to blank, tab or carriage return); empty at the end.
std::string_view take_word(std::string_view& text);

}  // namespace dipper::analysis::io
