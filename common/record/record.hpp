// record.h5: the signals of a run against time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/record/hdf5_handle.hpp"

namespace dipper::record {

/// record.h5: one dataset a channel, one row a sync step. Rows are collected in memory and appended
/// by `flush`, after which the file on disk is whole: a killed run's record opens up to there.
/// Every method throws std::runtime_error naming the file and the cause (a full disk, a text longer
/// than the 64 KiB that an attribute holds); the record cannot be used after that.
class Record {
 public:
  /// Creates the file; `attributes` go onto its root group.
  static Record create(const std::filesystem::path& file,
                       const std::map<std::string, std::string>& attributes);

  /// Opens the file of a resumed run and cuts every dataset back to `rows`. Channels must then
  /// be added again, in any order.
  static Record resume(const std::filesystem::path& file, std::size_t rows);
  ~Record();
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  /// Adds a dataset; names may hold '/' for groups. columns = 1: a vector, else rows x columns.
  std::size_t add(const std::string& name, const std::string& unit, const std::string& frame,
                  std::size_t columns = 1);

  /// Sets a channel in the current row; `values` holds its columns.
  void put(std::size_t channel, const double* values);
  void put(std::size_t channel, double value) { put(channel, &value); }

  /// Ends the row. Channels not put repeat their last values.
  void next();
  void flush();
  /// The same, and to the disk itself: it outlives a power failure.
  void sync();
  std::size_t rows() const { return rows_ + pending_; }

 private:
  Record(std::filesystem::path file, const std::map<std::string, std::string>* attributes,
         std::size_t rows);
  struct Dataset {
    std::string name;
    Hdf5Handle handle;
    std::size_t columns;
    std::vector<double> row, buffer;
  };
  [[noreturn]] void fail(const std::string& what);
  void write_text(const Hdf5Handle& object, const std::string& name, const std::string& text);

  std::filesystem::path file_;
  Hdf5Handle handle_;  // null when a write has failed
  bool resumed_ = false;
  std::vector<Dataset> datasets_;
  std::size_t rows_ = 0;     // on disk
  std::size_t pending_ = 0;  // in memory
};

/// Reads one column of a dataset of a record. Throws InputError naming file and dataset when it
/// is missing or damaged, also when it claims more rows than the file has bytes.
std::vector<double> read_channel(const std::filesystem::path& file, const std::string& name,
                                 std::size_t column = 0);

/// A text attribute of the file itself, such as "case_hash"; empty when it has none. Throws as
/// read_channel does.
std::string read_attribute(const std::filesystem::path& file, const std::string& name);

}  // namespace dipper::record
