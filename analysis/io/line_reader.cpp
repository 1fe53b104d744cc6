#include "analysis/io/line_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>

namespace dipper::analysis::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

InputError input_error(const std::filesystem::path& file, long line, const std::string& message) {
  return InputError({{file, static_cast<int>(line), "", message}});
}

std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> open_file(const std::filesystem::path& file) {
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> stream(gzopen(file.c_str(), "rb"), &gzclose);
  if (!stream || std::filesystem::is_directory(file))
    throw input_error(file, 0, fmt::format("cannot be read: {}", std::strerror(errno)));
  return stream;
}

bool LineReader::next(std::string_view& text) {
  std::size_t searched = 0;
  while (true) {
    const char* begin = buffer_.data() + read_;
    const void* end = std::memchr(begin + searched, '\n', filled_ - read_ - searched);
    if (end != nullptr) {
      text = {begin, static_cast<std::size_t>(static_cast<const char*>(end) - begin)};
      read_ += text.size() + 1;
      break;
    }
    searched = filled_ - read_;
    if (refill()) continue;
    if (searched == 0) return false;
    text = {buffer_.data() + read_, searched};
    read_ += searched;
    ended_whole_ = false;
    break;
  }
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  ++line_;
  return true;
}

std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

}  // namespace dipper::analysis::io
