// How far a settled bench is from its profile.
#pragma once

#include <filesystem>
#include <optional>

#include "coupler/case/case.hpp"

namespace dipper::result {

/// Of the surface seen from above (analysis/rock/surface_profile.hpp) against the outline, or the
/// median over y of a scanned surface, from toe to rear wall. A face steeper than the angle of
/// repose slumps before it is dug; these figures show by how much.
struct AchievedProfile {
  double below_mean_m = 0;         ///< outline less surface, mean
  double below_most_m = 0;         ///< largest, as a mean over one largest rock's width of x
  double below_most_x_m = 0;       ///< x of below_most_m
  std::optional<double> face_deg;  ///< slope of the flank (analysis/rock/pile_angle.hpp)
};

/// Reads the first frame of the particle dumps in `dumps`. Empty when there is no frame, or no rock
/// in it.
std::optional<AchievedProfile> achieved_profile(const cases::Case& c,
                                                const std::filesystem::path& dumps);

}  // namespace dipper::result
