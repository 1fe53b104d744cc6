#include "common/case_lines.hpp"

#include <algorithm>
#include <iterator>

#include "common/input_error.hpp"
#include "common/numbers.hpp"
#include "common/text_file.hpp"

namespace dipper {

CaseLines::CaseLines(std::string_view text) {
  int line_number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++line_number;
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    lines_.push_back(
        {std::string(line.substr(0, equals)), std::string(line.substr(equals + 1)), line_number});
  }
}

CaseLines CaseLines::read(const std::filesystem::path& file) {
  const std::optional<std::string> text = read_bytes(file);
  if (!text) throw InputError({{file, 0, "", "cannot be read; name a run's folder"}});
  return CaseLines(*text);
}

const CaseLine* CaseLines::find(std::string_view key) const {
  const auto at = std::find_if(lines_.begin(), lines_.end(),
                               [&](const CaseLine& line) { return line.key == key; });
  return at == lines_.end() ? nullptr : &*at;
}

std::optional<double> CaseLines::number(std::string_view key) const {
  const CaseLine* line = find(key);
  double value = 0;
  if (line == nullptr || !parse_number(line->value, value)) return std::nullopt;
  return value;
}

std::string CaseLines::text(std::string_view key) const {
  const CaseLine* line = find(key);
  if (line == nullptr) return "";
  const std::string& v = line->value;
  if (v.size() < 2 || v.front() != '"') return v;
  std::string out;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    if (v[i] == '\\') ++i;
    out += v[i];
  }
  return out;
}

}  // namespace dipper
