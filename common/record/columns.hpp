// Signals of a record that belong together, row by row.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dipper::record {

/// Columns of a record, all of one length: that of the shortest, as a run that is writing it may be
/// in the middle of a row.
class Columns {
 public:
  explicit Columns(std::filesystem::path record) : record_(std::move(record)) {}

  /// Throws as read_channel does, also for values that no run writes: values that are not finite,
  /// and times that do not rise, or that end after a day and more.
  void read(const std::string& channel, std::size_t column = 0);

  /// A column that was read.
  std::vector<double> get(const std::string& channel, std::size_t column = 0) const;

 private:
  std::filesystem::path record_;
  std::map<std::pair<std::string, std::size_t>, std::vector<double>> values_;
  std::size_t rows_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace dipper::record
