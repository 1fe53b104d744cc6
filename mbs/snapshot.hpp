// The full state of the shovel, and its file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mbs/shovel_system.hpp"

namespace dipper::mbs {

/// The shovel's state at a tick: a run that was saved and loaded is the same to the bit.
struct Snapshot {
  std::int64_t t_ns = 0;
  ShovelNumbers numbers;
  std::string drives = "prescribed";  ///< or the operator's kind
  std::vector<double> sender;         ///< the operator's state; none: the drives are prescribed
  Wrenches F_Bo_W;                    ///< held on dipper and door over the last window
  std::string rows;  ///< that its motion has gone on with, a motion.csv; empty: none
};

/// Throws std::runtime_error naming the file.
void save(const Snapshot& snapshot, const std::filesystem::path& file);

/// Reads the file of save, for a machine with drives of the same kind as `like`, and as many
/// numbers of each sort. Throws std::runtime_error naming the file and its fault.
Snapshot load_snapshot(const std::filesystem::path& file, const Snapshot& like);

}  // namespace dipper::mbs
