// How the hoist ropes are computed, as a machine's file says.
#pragma once

#include <filesystem>

namespace dipper::machine {

/// rope.model: elastic (default) or segmented; rope.elements and rope.mass_per_length are of the
/// latter.
struct RopeModel {
  bool segmented = false;
  int elements = 19;           ///< of one rope, as in Svanberg et al. 2021, Section 3.2
  double mass_per_length = 0;  ///< kg/m
};

/// Throws as load_machine does.
RopeModel load_rope_model(const std::filesystem::path& file);

}  // namespace dipper::machine
