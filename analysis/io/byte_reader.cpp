#include "analysis/io/byte_reader.hpp"

#include <zlib.h>

#include <cctype>
#include <cstring>

#include "analysis/io/line_reader.hpp"

namespace dipper::analysis::io {

namespace {
constexpr std::size_t kFirst = 1 << 12, kBuffer = 1 << 18;  // a header alone is cheap
}

ByteReader::ByteReader(std::filesystem::path file, std::int64_t offset, long line)
    : buffer_(kFirst),
      line_(line),
      file_(std::move(file)),
      stream_(open_file(file_)),
      base_(offset) {
  if (gzseek(stream_.get(), offset, SEEK_SET) < 0)
    throw input_error(file_, line, "cannot be read here");
  if (offset == 0 && next_is("\xEF\xBB\xBF")) read_ += 3;
}

bool ByteReader::refill() {
  std::memmove(buffer_.data(), buffer_.data() + read_, filled_ - read_);
  base_ += static_cast<std::int64_t>(read_);
  filled_ -= read_;
  read_ = 0;
  if (filled_ == buffer_.size()) buffer_.resize(2 * filled_);
  if (base_ > 0 && buffer_.size() < kBuffer) buffer_.resize(kBuffer);
  const int got = gzread(stream_.get(), buffer_.data() + filled_,
                         static_cast<unsigned>(buffer_.size() - filled_));
  int fault = Z_OK;
  if (got <= 0) gzerror(stream_.get(), &fault);
  if (fault == Z_BUF_ERROR)
    throw input_error(file_, line_, "the gzipped file ends too soon: it was cut short");
  if (got < 0 || fault < Z_OK) throw input_error(file_, line_, "cannot be read any further");
  filled_ += static_cast<std::size_t>(got);
  return got > 0;
}

void ByteReader::word(std::string& out) {
  out.clear();
  while (std::isspace(peek()) != 0) get();
  for (int c = peek(); c != kEnd && c != '<' && std::isspace(c) == 0; c = peek())
    out.push_back(static_cast<char>(get()));
}

std::string ByteReader::rest_of_line() {
  std::string out;
  for (int c = get(); c != kEnd && c != '\n'; c = get()) out.push_back(static_cast<char>(c));
  if (!out.empty() && out.back() == '\r') out.pop_back();
  return out;
}

bool ByteReader::next_is(const char* text) {
  const std::size_t n = std::strlen(text);
  if (filled_ - read_ < n) refill();
  return filled_ - read_ >= n && std::memcmp(buffer_.data() + read_, text, n) == 0;
}

bool ByteReader::bytes(char* out, std::size_t n) {
  while (n > 0) {
    if (read_ == filled_ && !refill()) return false;
    const std::size_t some = std::min(n, filled_ - read_);
    std::memcpy(out, buffer_.data() + read_, some);
    read_ += some;
    out += some;
    n -= some;
  }
  return true;
}

bool ByteReader::skip(std::int64_t n) {
  while (n > 0) {
    if (read_ == filled_ && !refill()) return false;
    const auto some = std::min<std::int64_t>(n, static_cast<std::int64_t>(filled_ - read_));
    read_ += static_cast<std::size_t>(some);
    n -= some;
  }
  return true;
}

}  // namespace dipper::analysis::io
