// The differences between the weight on the walls and the rock inside the dipper at rest.
#pragma once

#include "analysis/io/dump_folder.hpp"
#include "analysis/rock/zones.hpp"

namespace dipper::analysis::metrics {

/// Both belong to the weight on the walls, not to the rock counted inside.
struct SuspendedLoad {
  double riding_kg = 0;  ///< outside the dipper's region but carried: mean of frames
  std::optional<double> accelerating_kg;  ///< momentum gained upwards, by time and gravity
};

/// Over the frames from `from_s` to `to_s`; empty when there is no such frame, or it has no
/// velocities. Rock rides when it is within 1 m of the region, not in the truck, and moves with the
/// dipper (kFlowSpeed_m_s). The walls carry sum m (g + a): the second part is the change of
/// vertical momentum, from the first frame to the last, of the rock inside or riding in the first.
std::optional<SuspendedLoad> suspended_load(const io::DumpFolder& dumps,
                                            const rock::ClumpMasses& clumps,
                                            const rock::LoadRegions& regions,
                                            const rock::PoseTrack& dipper, double from_s,
                                            double to_s);

}  // namespace dipper::analysis::metrics
