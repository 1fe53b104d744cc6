#include "common/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "common/begins_with.hpp"
#include "common/numbers.hpp"
#include "common/row_faults.hpp"
#include "common/text_file.hpp"

namespace dipper {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The minus signs, blanks and line ends of word processors and spreadsheets, in UTF-8. dipper
// import knows the same (dipper_run/csv_text.py); tests/common/tables.jsonl holds both to it.
constexpr std::array<std::pair<std::string_view, char>, 14> kLookAlikes{{{"\u2212", '-'},
                                                                         {"\u2010", '-'},
                                                                         {"\u2011", '-'},
                                                                         {"\u2012", '-'},
                                                                         {"\u2013", '-'},
                                                                         {"\u2014", '-'},
                                                                         {"\uFE63", '-'},
                                                                         {"\uFF0D", '-'},
                                                                         {"\u00A0", ' '},
                                                                         {"\u2009", ' '},
                                                                         {"\u202F", ' '},
                                                                         {"\xC2\x85", '\n'},
                                                                         {"\u2028", '\n'},
                                                                         {"\u2029", '\n'}}};

/// What begins as no text, what it is, and what would be right. dipper import knows the same
/// (dipper_run/text_file.py); tests/common/tables.jsonl holds both to it.
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1A\n";  // or after a block of its writer's own
constexpr std::string_view kHdf5Is = "is HDF5; save its channels as CSV";
constexpr std::array<std::pair<std::string_view, std::string_view>, 18> kNoTexts{
    {{kHdf5, kHdf5Is},
     {"MATLAB 7.3 MAT-file", kHdf5Is},
     {"MATLAB 5.0 MAT-file", "is a MAT file of MATLAB; save its channels as CSV"},
     {"CDF\x01", "is NetCDF; save its channels as CSV"},
     {"CDF\x02", "is NetCDF; save its channels as CSV"},
     {"CDF\x05", "is NetCDF; save its channels as CSV"},
     {"MDF     ", "is MDF, of a measurement system; save its channels as CSV"},
     {"TDSm", "is TDMS, of a measurement system; save its channels as CSV"},
     {"PAR1\x15", "is Parquet; save its table as CSV"},
     {"SQLite format 3", "is a database of SQLite; save its table as CSV"},
     {"\xD0\xCF\x11\xE0",
      "is a spreadsheet (.xls), or another document of an office program; save its sheet as CSV"},
     {"{\\rtf", "is RTF, of a word processor; save it as plain text in UTF-8"},
     {"%PDF", "is a PDF; a table as CSV"},
     {"\x1F\x8B", "is compressed by gzip; unpack it with gunzip"},
     {"BZh91AY&SY", "is compressed by bzip2; unpack it with bunzip2"},
     {"\xFD\x37zXZ", "is compressed by xz; unpack it with unxz"},
     {"\x28\xB5\x2F\xFD", "is compressed by Zstandard; unpack it with unzstd"},
     {"7z\xBC\xAF\x27\x1C", "is an archive of 7-Zip; unpack it"}}};

/// What a file is and what would be right, where it begins as something that is no text; else
/// nothing.
std::string no_text(std::string_view text) {
  for (const auto& [begin, is] : kNoTexts)
    if (begins_with(text, begin)) return std::string(is);
  for (std::size_t at = 512; at < text.size(); at *= 2)
    if (text.substr(at, kHdf5.size()) == kHdf5) return std::string(kHdf5Is);
  if (begins_with(text, "PK\x03\x04")) {
    for (const std::string_view sheet :
         {"xl/workbook", "xl/worksheets", "application/vnd.oasis.opendocument.spreadsheet"})
      if (text.find(sheet) != std::string_view::npos)
        return "is a spreadsheet; save its sheet as CSV";
    return "is a ZIP; unpack it";
  }
  if (begins_with(text, kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  std::string begin(text.substr(0, 16));
  for (char& c : begin)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  for (const std::string_view tag : {"<html", "<!doctype", "<table", "<?xml", "<meta"})
    if (begins_with(begin, tag))
      return "is HTML or XML, which some programs save as .xls; save its table as CSV";
  return {};
}

/// The text with line ends of Windows and of early Macs as \n, and plain minus signs and blanks.
std::string plain(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const auto* alike = std::find_if(kLookAlikes.begin(), kLookAlikes.end(), [&](const auto& a) {
      return text.compare(i, a.first.size(), a.first) == 0;
    });
    if (alike != kLookAlikes.end()) {
      out += alike->second;
      i += alike->first.size();
    } else if (text[i] == '\r') {
      while (i < text.size() && text[i] == '\r') ++i;
      if (i < text.size() && text[i] == '\n') ++i;
      out += '\n';
    } else {
      out += text[i++];
    }
  }
  return out;
}

std::string_view trim(std::string_view s) {
  const auto first = s.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t") - first + 1);
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

/// Where the field that begins at `begin` ends: at a delimiter outside quotes.
std::size_t end_of_field(std::string_view line, std::size_t begin, char delimiter) {
  const std::size_t first = line.find_first_not_of(" \t", begin);
  std::size_t from = begin;
  if (first != std::string_view::npos && line[first] == '"' && delimiter != '"')
    if (const auto close = line.find('"', first + 1); close != std::string_view::npos) from = close;
  return std::min(line.find(delimiter, from), line.size());
}

std::vector<Field> split(std::string_view line, char delimiter) {
  std::vector<Field> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = end_of_field(line, begin, delimiter);
    fields.push_back({unquote(trim(line.substr(begin, end - begin))), static_cast<int>(begin) + 1});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

/// Drops empty fields beyond the first `n`, which spreadsheets leave of deleted columns.
void drop_empty_tail(std::vector<Field>& fields, std::size_t n) {
  while (fields.size() > n && fields.back().text.empty()) fields.pop_back();
}

bool is_empty(const std::vector<Field>& fields) {
  return std::all_of(fields.begin(), fields.end(), [](const Field& f) { return f.text.empty(); });
}

/// A spreadsheet's first line "sep=;".
bool names_separator(std::string_view line) {
  return line.size() == 5 && (line.substr(0, 4) == "sep=" || line.substr(0, 4) == "SEP=");
}

/// The layout of a table's lines. `place[i]` is the field of the column i.
struct Layout {
  char delimiter = 0;  ///< 0: no header yet
  std::vector<std::size_t> place;
  std::string_view header;  ///< the line, which may stand again among the rows
};

/// The layout by a header; without a delimiter when the header does not name the columns.
Layout find_layout(std::string_view line, const std::vector<std::string>& columns) {
  for (const char delimiter : {',', ';', '\t', '|'}) {
    std::vector<Field> fields = split(line, delimiter);
    drop_empty_tail(fields, columns.size());
    Layout layout{delimiter, {}, line};
    for (const std::string& name : columns) {
      const auto at = std::find_if(fields.begin(), fields.end(),
                                   [&](const Field& f) { return f.text == name; });
      if (at != fields.end()) layout.place.push_back(static_cast<std::size_t>(at - fields.begin()));
    }
    if (fields.size() == columns.size() && layout.place.size() == columns.size()) return layout;
  }
  return {};
}

/// A number without the unit that follows it: "2 %" of passing_percent, "0.5 m" of size_m.
std::string_view without_unit(std::string_view text, const std::string& column) {
  const std::string unit = column.substr(column.find_last_of('_') + 1);
  for (const std::string_view word :
       {std::string_view(unit), std::string_view(unit == "percent" ? "%"
                                                 : unit == "deg"   ? "°"
                                                                   : "")})
    if (!word.empty() && text.size() > word.size() &&
        text.substr(text.size() - word.size()) == word)
      return trim(text.substr(0, text.size() - word.size()));
  return text;
}

/// "-0.5" of "- 0.5", as accountants write it.
std::string without_blanks_after_sign(std::string_view text) {
  std::string out(text);
  if (out.empty() || (out[0] != '-' && out[0] != '+')) return out;
  return out.substr(0, 1) + std::string(trim(text.substr(1)));
}

/// (200.0) or 200.0-, which accountants mean as -200.0.
bool has_minus_elsewhere(std::string_view s) {
  if (s.size() < 2) return false;
  const bool boxed = s.front() == '(' && s.back() == ')';
  if (boxed) s.remove_prefix(1);
  return (boxed || s.back() == '-') &&
         s.substr(0, s.size() - 1).find_first_not_of("0123456789., ") == std::string_view::npos;
}

bool looks_like_date(std::string_view s) {
  return s.size() >= 10 && s[4] == '-' && s[7] == '-' &&
         s.find_first_not_of("0123456789-T:+Z., ") == std::string_view::npos;
}

/// 943,981 or -1,234,567: commas that may separate thousands, or one that has three decimals.
bool is_grouped(std::string_view s) {
  if (!s.empty() && (s[0] == '+' || s[0] == '-')) s.remove_prefix(1);
  const std::size_t first = std::min(s.find(','), s.size());
  if (first < 1 || first > 3 || s[0] == '0' || s.size() == first || (s.size() - first) % 4 != 0)
    return false;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const bool mark = i >= first && (i - first) % 4 == 0;
    if (mark ? s[i] != ',' : s[i] < '0' || s[i] > '9') return false;
  }
  return true;
}

/// Reads the fields of one table. The first number with a comma or a point decides whether the
/// table has decimal commas. Where commas separate columns, only a quoted number can have one.
class NumberReader {
 public:
  bool read(std::string_view text, double& value) {
    const auto mark = text.find_first_of(".,");
    if (mark == std::string_view::npos) return parse_number(text, value);
    if (decimal_ == 0) decimal_ = text[mark];
    if (text[mark] != decimal_) return false;
    std::string plain(text);
    plain[mark] = '.';
    if (!parse_number(plain, value)) return false;
    commas_are_decimal_ = commas_are_decimal_ || (decimal_ == ',' && !is_grouped(text));
    return true;
  }

  /// Whether some number has a comma that separates no thousands.
  bool commas_are_decimal() const { return commas_are_decimal_; }

  std::string right(std::string_view text) const {
    if (looks_like_date(text)) return "a finite number; dipper import reads time stamps";
    if (has_minus_elsewhere(text)) return "a finite number, with its minus in front";
    if (decimal_ == ',') return "a finite number, with a decimal comma as elsewhere in the file";
    return "a finite number";
  }

 private:
  char decimal_ = 0;
  bool commas_are_decimal_ = false;
};

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text, const std::filesystem::path& file,
                              const std::vector<std::string>& columns,
                              std::vector<Finding>& findings, const std::string& name_column) {
  if (const std::string other = no_text(text); !other.empty()) {
    findings.push_back({file, 0, "", other});
    return {};
  }
  if (begins_with(text, kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (text.find('\0') != std::string_view::npos) {
    findings.push_back({file, 0, "", "is UTF-16, or no text; save it as plain text in UTF-8"});
    return {};
  }
  const std::string header = fmt::format("{}", fmt::join(columns, ","));
  const std::string all = plain(text);
  text = all;
  std::vector<CsvRow> rows;
  RowFaults faults;
  NumberReader number;
  int line_number = 0;
  Layout layout;
  std::optional<Finding> grouped;  // the first number whose commas may separate thousands
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t newline = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, newline - begin);
    begin = newline + 1;
    ++line_number;
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    if (layout.delimiter == 0) {
      if (rows.empty() && names_separator(content)) continue;
      layout = find_layout(line, columns);
      if (layout.delimiter == 0) {
        findings.push_back({file, line_number, "",
                            fmt::format("header is \"{}\"; it must be \"{}\"", content, header),
                            1});
        return rows;
      }
      continue;
    }
    std::vector<Field> fields = split(line, layout.delimiter);
    if (is_empty(fields) || line == layout.header) continue;
    drop_empty_tail(fields, columns.size());
    if (fields.size() != columns.size()) {
      const bool commas = layout.delimiter == ',' && fields.size() > columns.size();
      faults.add(
          "", line_number, static_cast<int>(line.size()) + 1,
          fmt::format("{} columns", fields.size()),
          fmt::format("each row has {}: {}{}", columns.size(), header,
                      commas ? "; with decimal commas, separate the columns by semicolons" : ""));
      continue;
    }
    CsvRow row{line_number, std::vector<double>(columns.size()), {}};
    bool sound = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Field& field = fields[layout.place[i]];
      if (columns[i] == name_column) {
        row.name = field.text;
        continue;
      }
      const std::string bare = without_blanks_after_sign(without_unit(field.text, columns[i]));
      if (!grouped && is_grouped(bare))
        grouped = {
            file, line_number, "",
            fmt::format("{} is \"{}\": every comma in the file has three digits after it, "
                        "and may separate thousands; write decimals with a point, and nothing "
                        "between thousands",
                        columns[i], field.text),
            field.column};
      if (number.read(bare, row.values[i])) continue;
      faults.add(columns[i], line_number, field.column,
                 fmt::format("{} is \"{}\"", columns[i], field.text),
                 "it must be " + number.right(field.text));
      sound = false;
    }
    if (sound) rows.push_back(std::move(row));
  }
  faults.report(file, findings);
  if (grouped && !number.commas_are_decimal() && faults.empty()) findings.push_back(*grouped);
  if (layout.delimiter == 0)
    findings.push_back(
        {file, line_number + 1, "", fmt::format("no header; it must be \"{}\"", header), 1});
  return rows;
}

std::vector<CsvRow> read_csv(const std::filesystem::path& file,
                             const std::vector<std::string>& columns,
                             std::vector<Finding>& findings, const std::string& name_column) {
  const std::optional<std::string> text = read_bytes(file);
  if (!text) {
    findings.push_back({file, 0, "", "cannot be opened"});
    return {};
  }
  return parse_csv(*text, file, columns, findings, name_column);
}

}  // namespace dipper
