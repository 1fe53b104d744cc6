// What the shovel's future depends on, and its file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "mbs/shovel_tree.hpp"

namespace dipper::mbs {

/// The shovel's state at a tick: going back is free, and a run that was saved, loaded or predicted
/// cannot differ by a bit.
struct Snapshot {
  std::int64_t t_ns = 0;
  Joints q = Joints::Zero();                        ///< joint coordinates, m and rad
  Joints u = Joints::Zero();                        ///< joint speeds, m/s and rad/s
  Eigen::Vector3d works = Eigen::Vector3d::Zero();  ///< J: by the drives, by the rock, dissipated
  std::vector<double> path;  ///< the operator's PathState; none: the drives are prescribed
  Eigen::VectorXd rope;      ///< of one side: a segmented rope's nodes; none: elastic ropes
  Wrenches F_Bo_W;           ///< held on dipper and door over the last window
};

/// Throws std::runtime_error naming the file.
void save(const Snapshot& snapshot, const std::filesystem::path& file);

/// Reads what save wrote, for a machine with as many coordinates, speeds and works as `like`,
/// and drives of its kind.
/// Throws std::runtime_error naming the file and what is wrong with it.
Snapshot load_snapshot(const std::filesystem::path& file, const Snapshot& like);

}  // namespace dipper::mbs
