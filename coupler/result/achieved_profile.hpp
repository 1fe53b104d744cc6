// How far a settled bench is from the profile it was cut to.
#pragma once

#include <filesystem>
#include <optional>

#include "coupler/case/case.hpp"

namespace dipper::result {

/// Of the surface seen from above (analysis/rock/surface_profile.hpp) against the outline, or the
/// median over y of a scanned surface, from toe to rear wall. A face steeper than rock stands has
/// slumped by the time it is dug: what it lost shows here.
struct AchievedProfile {
  double below_mean_m = 0;    ///< outline less surface, mean
  double below_most_m = 0;    ///< largest, as a mean over one largest rock's width of x
  double below_most_x_m = 0;  ///< there
  double face_deg = 0;  ///< slope of the flank (analysis/rock/pile_angle.hpp); 0: there is none
};

/// Looks at the first frame of the particle dumps in `dumps`. None when there is no frame, or no
/// rock in it.
std::optional<AchievedProfile> achieved_profile(const cases::Case& c,
                                                const std::filesystem::path& dumps);

}  // namespace dipper::result
