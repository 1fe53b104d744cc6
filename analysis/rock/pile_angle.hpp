// The slope angle of a pile's flank.
#pragma once

#include <limits>
#include <vector>

#include "analysis/rock/surface_profile.hpp"

namespace dipper::analysis::rock {

struct PileAngleOptions {
  // The part to measure, of a heap with two flanks or a pile that continues behind its crest.
  double x_min_m = -std::numeric_limits<double>::infinity();
  double x_max_m = std::numeric_limits<double>::infinity();
  double floor_m = 0;  ///< ground level
  // The flank is the part between these fractions of the height: the toe is flat, the crest
  // rounded.
  double lower_fraction = 0.2;
  double upper_fraction = 0.8;
};

/// A straight line through the flank, z = z0 + slope (x - x0).
struct PileAngle {
  double angle_deg = 0;             ///< from the ground, 0 ... 90, whichever side the flank faces
  double sigma_deg = 0;             ///< standard error, over samples of the same roughness
  double slope = 0;                 ///< dz/dx, signed
  double x0_m = 0, z0_m = 0;        ///< a point on the line: the flank's centre
  double x_from_m = 0, x_to_m = 0;  ///< the flank
  double height_m = 0;              ///< of the pile over the floor
};

/// Finds the flank (from where the smoothed profile last leaves the lower height to where it first
/// reaches the upper), fits it by the median of the slopes of all pairs of bins (Theil 1950, Sen
/// 1968: tolerates 29 % of outliers), and estimates the error by a block bootstrap: residuals of
/// neighbouring bins belong to one rock, so blocks of `grain_m`, the size of the largest rocks, are
/// resampled. Deterministic. Throws std::invalid_argument when there is no flank of at least 5
/// bins.
PileAngle pile_angle(const SurfaceProfile& profile, double grain_m,
                     const PileAngleOptions& options = {});

/// The same from the balls, with grain_m twice the largest radius.
PileAngle pile_angle(const std::vector<Sphere>& balls, const PileAngleOptions& options = {});

}  // namespace dipper::analysis::rock
