#include "common/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "common/numbers.hpp"

namespace dipper {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr int kFew = 3;  // faults of one kind that are told one by one

std::string_view trim(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

std::string_view unquote(std::string_view s) {
  const bool quoted = s.size() > 1 && s.front() == '"' && s.back() == '"';
  return quoted ? trim(s.substr(1, s.size() - 2)) : s;
}

/// A field of a row, and the 1-based column where it begins.
struct Field {
  std::string_view text;
  int column;
};

std::vector<Field> split(std::string_view line, char delimiter) {
  std::vector<Field> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(line.find(delimiter, begin), line.size());
    fields.push_back({unquote(trim(line.substr(begin, end - begin))), static_cast<int>(begin) + 1});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

/// What parts the columns of a header; 0 when it does not name them.
char find_delimiter(std::string_view line, const std::vector<std::string>& columns) {
  for (const char delimiter : {',', ';', '\t'}) {
    const std::vector<Field> fields = split(line, delimiter);
    if (std::equal(fields.begin(), fields.end(), columns.begin(), columns.end(),
                   [](const Field& f, const std::string& name) { return f.text == name; }))
      return delimiter;
  }
  return 0;
}

bool looks_like_date(std::string_view s) {
  return s.size() >= 10 && s[4] == '-' && s[7] == '-' &&
         s.find_first_not_of("0123456789-T:+Z., ") == std::string_view::npos;
}

/// Reads the fields of one table: whether its numbers have decimal commas shows in the first that
/// has a comma or a point.
class NumberReader {
 public:
  explicit NumberReader(char delimiter) : may_have_commas_(delimiter != ',') {}

  bool read(std::string_view text, double& value) {
    const auto mark = text.find_first_of(".,");
    if (mark == std::string_view::npos || !may_have_commas_) return parse_number(text, value);
    if (decimal_ == 0) decimal_ = text[mark];
    if (text[mark] != decimal_) return false;
    std::string plain(text);
    plain[mark] = '.';
    return parse_number(plain, value);
  }

  std::string right(std::string_view text) const {
    if (looks_like_date(text)) return "a finite number; dipper import reads time stamps";
    if (decimal_ == ',') return "a finite number, with a decimal comma as elsewhere in the file";
    return "a finite number";
  }

 private:
  bool may_have_commas_;
  char decimal_ = 0;
};

/// Faults of rows. One cause is one finding: of more than a few of a kind the first stands for all.
class RowFaults {
 public:
  void add(std::string kind, int line, int column, std::string wrong, std::string right) {
    ++count_[kind];
    faults_.push_back({std::move(kind), line, column, std::move(wrong), std::move(right)});
  }

  void tell(const std::filesystem::path& file, std::vector<Finding>& findings) const {
    std::set<std::string> told;
    for (const Fault& f : faults_) {
      const int n = count_.at(f.kind);
      if (n > kFew && !told.insert(f.kind).second) continue;
      const std::string more = n > kFew ? fmt::format(", and so in {} more lines", n - 1) : "";
      findings.push_back({file, f.line, "", f.wrong + more + "; " + f.right, f.column});
    }
  }

 private:
  struct Fault {
    std::string kind;
    int line, column;
    std::string wrong, right;
  };
  std::vector<Fault> faults_;
  std::map<std::string, int> count_;
};

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text, const std::filesystem::path& file,
                              const std::vector<std::string>& columns,
                              std::vector<Finding>& findings) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    text.remove_prefix(kByteOrderMark.size());
  if (text.find('\0') != std::string_view::npos) {
    findings.push_back({file, 0, "", "is UTF-16, or no text; save it as plain text in UTF-8"});
    return {};
  }
  const std::string header = fmt::format("{}", fmt::join(columns, ","));
  std::vector<CsvRow> rows;
  RowFaults faults;
  NumberReader number(',');
  int line_number = 0;
  char delimiter = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, newline - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    begin = newline + 1;
    ++line_number;
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    if (delimiter == 0) {
      delimiter = find_delimiter(line, columns);
      if (delimiter == 0) {
        findings.push_back({file, line_number, "",
                            fmt::format("header is \"{}\"; it must be \"{}\"", content, header),
                            1});
        return rows;
      }
      number = NumberReader(delimiter);
      continue;
    }
    const std::vector<Field> fields = split(line, delimiter);
    if (fields.size() != columns.size()) {
      const bool commas = delimiter == ',' && fields.size() > columns.size();
      faults.add("", line_number, static_cast<int>(line.size()) + 1,
                 fmt::format("{} columns", fields.size()),
                 fmt::format("each row has {}: {}{}", columns.size(), header,
                             commas ? "; with decimal commas, semicolons part the columns" : ""));
      continue;
    }
    CsvRow row{line_number, std::vector<double>(columns.size())};
    bool sound = true;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (number.read(fields[i].text, row.values[i])) continue;
      faults.add(columns[i], line_number, fields[i].column,
                 fmt::format("{} is \"{}\"", columns[i], fields[i].text),
                 "it must be " + number.right(fields[i].text));
      sound = false;
    }
    if (sound) rows.push_back(std::move(row));
  }
  faults.tell(file, findings);
  if (delimiter == 0)
    findings.push_back(
        {file, line_number + 1, "", fmt::format("no header; it must be \"{}\"", header), 1});
  return rows;
}

std::vector<CsvRow> read_csv(const std::filesystem::path& file,
                             const std::vector<std::string>& columns,
                             std::vector<Finding>& findings) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) {
    findings.push_back({file, 0, "", "cannot be opened"});
    return {};
  }
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return parse_csv(text, file, columns, findings);
}

}  // namespace dipper
