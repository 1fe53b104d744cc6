// A slice through the middle of the dipper, as in Fig. 14 of Svanberg et al. 2021.
#pragma once

#include <array>
#include <vector>

#include "analysis/report/replay_source.hpp"

namespace dipper::analysis::report {

/// The vertical plane through the dipper's origin that its lateral axis is normal to; `out` points
/// to the face, `up` away from the ground [m], both from the dipper's origin.
struct SliceSphere {
  double out, up, radius;
  std::int64_t rock;      ///< as ReplaySphere::rock
  double relative_speed;  ///< [m/s] of the sphere in the moving dipper
  Eigen::Vector3d p_B;    ///< [m]
};
struct SliceSegment {
  std::array<double, 2> from, to;  ///< (out, up)
};
struct Slice {
  double time_s = 0;
  std::vector<SliceSphere> spheres;  ///< far ones first
  std::vector<SliceSegment> walls;   ///< their intersections with the plane
};

struct SliceWindow {
  double thickness_m = 1.0;  ///< "approximately 1 m": the paper, Fig. 14
  double reach_m = 6.5;      ///< out and up from the middle of the dipper, either way
};

/// The plane of the slice in one frame; the window is around the middle of the dipper's mesh.
class SlicePlane {
 public:
  SlicePlane(const BodyState& dipper, const mesh::TriangleMesh& mesh,
             const SliceWindow& window = {});

  /// (out, to the left, up) of a point in W, from the dipper's origin.
  Vector3d seen(const Vector3d& p_W) const;
  bool in_window(double out, double up, double margin_m = 0) const;
  bool holds(const ReplaySphere& sphere) const;

 private:
  SliceWindow window_;
  Vector3d origin_, out_, side_, middle_;
};

/// `dipper` is the index of the dipper among the walls. Spheres off the slice may be missing.
Slice slice(const ReplayFrame& frame, const std::vector<ReplayWall>& walls, std::size_t dipper,
            const SliceWindow& window = {});

}  // namespace dipper::analysis::report
