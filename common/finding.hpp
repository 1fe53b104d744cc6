// Faults of an input, and their places.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dipper {

/// A place in a file; line 0: none, as for the command line.
struct Origin {
  std::filesystem::path file;
  int line = 0;  ///< 1-based
};

/// One fault. The message says what is wrong and what would be right.
struct Finding {
  std::filesystem::path file;
  int line = 0;     ///< 1-based; 0: none
  std::string key;  ///< dotted; may be empty
  std::string message;
  int column = 0;  ///< 1-based, in bytes; 0: none
};

/// "file:line:column: key: message", without the parts that are empty. All faults are printed so.
std::string to_string(const Finding& finding);

/// Sorts findings from the `first` on by line; those of one line keep their order.
void sort_by_line(std::vector<Finding>& findings, std::size_t first = 0);

}  // namespace dipper
