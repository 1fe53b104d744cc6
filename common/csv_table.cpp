#include "common/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "common/numbers.hpp"

namespace dipper {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trim(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

/// A field of a row, and the 1-based column where it begins.
struct Field {
  std::string_view text;
  int column;
};

std::vector<Field> split(std::string_view line) {
  std::vector<Field> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    fields.push_back({trim(line.substr(begin, comma - begin)), static_cast<int>(begin) + 1});
    if (comma == line.size()) return fields;
    begin = comma + 1;
  }
}

bool is_header(const std::vector<Field>& fields, const std::vector<std::string>& columns) {
  return std::equal(fields.begin(), fields.end(), columns.begin(), columns.end(),
                    [](const Field& f, const std::string& name) { return f.text == name; });
}

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text, const std::filesystem::path& file,
                              const std::vector<std::string>& columns,
                              std::vector<Finding>& findings) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    text.remove_prefix(kByteOrderMark.size());
  const std::string header = fmt::format("{}", fmt::join(columns, ","));
  std::vector<CsvRow> rows;
  int line_number = 0;
  const auto fault = [&](int column, const std::string& message) {
    findings.push_back({file, line_number, "", message, column});
  };
  bool header_seen = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, newline - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    begin = newline + 1;
    ++line_number;
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    const std::vector<Field> fields = split(line);
    if (!header_seen) {
      if (!is_header(fields, columns)) {
        fault(1, fmt::format("header is \"{}\"; it must be \"{}\"", content, header));
        return rows;
      }
      header_seen = true;
      continue;
    }
    if (fields.size() != columns.size()) {
      fault(static_cast<int>(line.size()) + 1,
            fmt::format("{} columns; each row has {}: {}", fields.size(), columns.size(), header));
      continue;
    }
    CsvRow row{line_number, std::vector<double>(columns.size())};
    bool sound = true;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (parse_number(fields[i].text, row.values[i])) continue;
      fault(fields[i].column,
            fmt::format("{} is \"{}\"; it must be a finite number", columns[i], fields[i].text));
      sound = false;
    }
    if (sound) rows.push_back(std::move(row));
  }
  if (!header_seen) {
    ++line_number;
    fault(1, fmt::format("no header; it must be \"{}\"", header));
  }
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
