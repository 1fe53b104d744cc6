// What the shovel's future depends on, and its file.
#pragma once

#include <Simbody.h>

#include <array>
#include <cstdint>
#include <filesystem>

#include "common/frames.hpp"

namespace dipper::mbs {

/// The shovel's state at a tick. Simbody's State is scratch that is set from this, so going back
/// is free, and a run that was saved, loaded or predicted cannot differ by a bit.
struct Snapshot {
  std::int64_t t_ns = 0;
  SimTK::Vector q;               ///< joint coordinates, m and rad
  SimTK::Vector u;               ///< joint speeds, m/s and rad/s
  SimTK::Vector works;           ///< J: by the drives, by the rock, dissipated; since t = 0
  SimTK::Vector path;            ///< the operator's PathState; none: the drives are prescribed
  std::array<Wrench, 2> F_Bo_W;  ///< held on dipper and door over the last window
};

bool is_finite(const SimTK::Vector& v);

/// Throws std::runtime_error naming the file.
void save(const Snapshot& snapshot, const std::filesystem::path& file);

/// Reads what save wrote, for a machine with as many coordinates, speeds and works as `like`,
/// and drives of its kind.
/// Throws std::runtime_error naming the file and what is wrong with it.
Snapshot load_snapshot(const std::filesystem::path& file, const Snapshot& like);

}  // namespace dipper::mbs
