#include "common/text_file.hpp"

#include <array>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "common/draft_file.hpp"

namespace dipper {

std::optional<std::string> read_bytes(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_character_file(file, unknown)) return std::nullopt;  // may never end
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes;
  std::array<char, 1 << 16> part;
  // istream::read turns a failed system call into badbit; iterators over the buffer would throw.
  while (in.read(part.data(), part.size()), in.gcount() > 0)
    bytes.append(part.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad()) return std::nullopt;
  return bytes;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  const DraftFile draft(file);
  std::ofstream out(draft.path(), std::ios::binary);
  out << text;
  out.close();
  std::error_code failed;
  if (out) draft.keep(failed);
  if (!out || failed)
    throw std::runtime_error(file.string() +
                             ": cannot be written; is the disk full, or the folder not yours?");
}

void copy_contents(const std::filesystem::path& from, const std::filesystem::path& to) {
  const std::optional<std::string> bytes = read_bytes(from);
  if (!bytes) throw std::runtime_error(from.string() + ": cannot be read");
  write_text(to, *bytes);
}

}  // namespace dipper
