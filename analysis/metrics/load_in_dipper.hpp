// The load in the dipper, from the dumps.
#pragma once

#include <optional>

#include "analysis/io/dump_folder.hpp"
#include "analysis/rock/rocks.hpp"
#include "analysis/rock/zones.hpp"
#include "analysis/signals/pass_phases.hpp"

namespace dipper::analysis::metrics {

struct LoadInDipper {
  double mass_kg = 0;
  double volume_m3 = 0;  ///< including voids (analysis/rock/load.hpp)

  double bulk_density_kg_m3() const { return mass_kg / volume_m3; }
};

/// The last frame at or before a time; the first frame if there is none.
std::size_t frame_before(const io::DumpFolder& dumps, double t);

/// The last frame before the load is swung away.
std::size_t lift_frame(const io::DumpFolder& dumps, const signals::PassPhases& pass);

/// In the last frame before the door opens. Empty when there is no frame of the dig, no region of
/// the dipper, or no rock in it. Throws InputError as the dumps' readers do.
std::optional<LoadInDipper> load_in_dipper(const io::DumpFolder& dumps,
                                           const rock::ClumpMasses& clumps,
                                           const rock::LoadRegions& regions,
                                           const rock::PoseTrack& dipper,
                                           const signals::PassPhases& pass);

}  // namespace dipper::analysis::metrics
