// The pile in a frame: its surface and slope angle.
#pragma once

#include "analysis/metrics/frame_survey.hpp"
#include "analysis/rock/pile_angle.hpp"
#include "common/box.hpp"

namespace dipper::analysis::metrics {

struct PileSurface {
  rock::SurfaceProfile profile;
  std::optional<rock::PileAngle> angle;  ///< empty: there is no flank
};

/// Of the rock over the footprint that is neither in the dipper nor in the truck. Of a frame of
/// more than a few hundred thousand spheres only those near the top of their column are kept in
/// memory.
PileSurface pile_surface(const io::DumpFrame& frame, const rock::LoadRegions& regions,
                         const Pose& X_WB, const Footprint& footprint, double floor_m);

/// z under the lowest rock over the footprint, m; 0 without any.
double lowest_m(const io::DumpFrame& frame, const Footprint& footprint);

/// The spheres of a frame whose centres are in a region of the body, in B.
std::vector<Sphere> balls_in(const io::DumpFrame& frame, const Box& region, const Pose& X_WB);

/// z of a profile at x, straight between its bins.
double height_at(const rock::SurfaceProfile& profile, double x_m);

}  // namespace dipper::analysis::metrics
