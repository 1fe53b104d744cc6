// Tables of numbers in text, with commas, semicolons, tabs or bars between them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/finding.hpp"

namespace dipper {

/// One row and its line.
struct CsvRow {
  int line = 0;                ///< 1-based
  std::vector<double> values;  ///< one a column; 0 of the column of names
  std::string name;            ///< of the column of names, where there is one
};

/// Reads a table whose first line names `columns`, these and no others, in any order, and whose
/// every other line has a number (common/numbers.hpp) for each; a row's values are in the order of
/// `columns`. The delimiter of the header is that of the rows. Numbers may have decimal commas: all
/// of them, and in quotes where commas separate the columns. Accepted and ignored, as spreadsheets
/// write them: a byte-order mark, line ends of any system, quotes and blanks around names and
/// numbers, the unit after a number, minus signs of word processors, empty columns at the end,
/// empty lines and rows, the header again, "sep=;" before the header, lines that begin with #.
/// Faults are appended to `findings` with line and column: a wrong header, after which nothing is
/// read; too many or too few columns; a field that is not a number; commas that all have three
/// digits after them. Of many faults of one kind only the first is reported. The result has the
/// sound rows. `file` is for the findings only. `name_column`: the one of `columns` that holds
/// texts.
std::vector<CsvRow> parse_csv(std::string_view text, const std::filesystem::path& file,
                              const std::vector<std::string>& columns,
                              std::vector<Finding>& findings, const std::string& name_column = {});

/// Reads a file; a file that cannot be read is a finding, too.
std::vector<CsvRow> read_csv(const std::filesystem::path& file,
                             const std::vector<std::string>& columns,
                             std::vector<Finding>& findings, const std::string& name_column = {});

}  // namespace dipper
