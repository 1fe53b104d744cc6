// What is wrong with an input, and where.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dipper {

/// A place in a file; line 0: none, as for what was said on the command line.
struct Origin {
  std::filesystem::path file;
  int line = 0;  ///< 1-based
};

/// One fault. The message says what is wrong and what would be right.
struct Finding {
  std::filesystem::path file;
  int line = 0;     ///< 1-based; 0: none
  std::string key;  ///< dotted; empty: none
  std::string message;
  int column = 0;  ///< 1-based, in bytes; 0: none
};

/// "file:line:column: key: message", without what there is none of. The one way a fault is printed.
std::string to_string(const Finding& finding);

/// Puts findings from the `first` on in the order of their lines; others of a line stay as they
/// are.
void sort_by_line(std::vector<Finding>& findings, std::size_t first = 0);

}  // namespace dipper
