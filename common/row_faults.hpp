// Faults of the rows of a table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/finding.hpp"

namespace dipper {

/// Collects faults of rows. If there are more than three of one kind, only the first is reported,
/// with the number of the others.
class RowFaults {
 public:
  /// `column` is that of the byte, 0: none.
  void add(std::string kind, int line, int column, std::string wrong, std::string right);

  bool empty() const { return faults_.empty(); }

  /// Adds "wrong; right" of each to the findings.
  void report(const std::filesystem::path& file, std::vector<Finding>& findings) const;

 private:
  struct Fault {
    std::string kind;
    int line, column;
    std::string wrong, right;
  };
  std::vector<Fault> faults_;
};

}  // namespace dipper
