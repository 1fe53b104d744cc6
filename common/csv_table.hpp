// Tables of numbers in text, with commas, semicolons, tabs or bars between them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/finding.hpp"

namespace dipper {

/// One row and where it stands.
struct CsvRow {
  int line = 0;                ///< 1-based
  std::vector<double> values;  ///< one a column; 0 of the column of names
  std::string name;            ///< of the column of names, where there is one
};

/// Reads a table whose first line names `columns`, these and no others, in any order, and whose
/// every other line has a number (common/numbers.hpp) for each; a row's values are in the order of
/// `columns`. What parts the names parts the numbers; these may have decimal commas, all of them,
/// in quotes where commas part the columns. As spreadsheets leave them, and left out of account:
/// a byte-order mark, line ends of any system, quotes and blanks round names and numbers, a
/// number's own unit behind it, minus signs of word processors, empty columns at the end, empty
/// lines and rows, "sep=;" before the header, lines that begin with #. Faults are appended to
/// `findings` with line and column: a wrong header, after which nothing is read, too many or too
/// few columns, a field that is no number, commas that have three digits after them all; one of a
/// kind stands for all where they are many. The result has the rows that are sound. `file` is for
/// the findings only. `name_column`: the one of `columns` that holds texts.
std::vector<CsvRow> parse_csv(std::string_view text, const std::filesystem::path& file,
                              const std::vector<std::string>& columns,
                              std::vector<Finding>& findings, const std::string& name_column = {});

/// The same of a file; that it cannot be read is a finding too.
std::vector<CsvRow> read_csv(const std::filesystem::path& file,
                             const std::vector<std::string>& columns,
                             std::vector<Finding>& findings, const std::string& name_column = {});

}  // namespace dipper
