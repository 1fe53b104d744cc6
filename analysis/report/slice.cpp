#include "analysis/report/slice.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::analysis::report {
namespace {

/// The segment in which the plane h = 0 cuts a triangle with heights h at its corners.
bool cut(const std::array<Eigen::Vector3d, 3>& corners, SliceSegment& segment) {
  int n = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % 3];
    if ((a.y() < 0) == (b.y() < 0)) continue;
    const Eigen::Vector3d p = a + (b - a) * (a.y() / (a.y() - b.y()));
    (n++ == 0 ? segment.from : segment.to) = {p.x(), p.z()};
  }
  return n == 2;
}

}  // namespace

SlicePlane::SlicePlane(const BodyState& dipper, const mesh::TriangleMesh& mesh,
                       const SliceWindow& window)
    : window_(window), origin_(dipper.X_WB.p) {
  const Vector3d lateral = dipper.X_WB.R * Vector3d::UnitY();
  out_ = lateral.cross(Vector3d::UnitZ()).normalized();
  side_ = Vector3d::UnitZ().cross(out_);
  const Box box = mesh::bounding_box(mesh);
  middle_ = seen(dipper.X_WB * Vector3d(0.5 * (box.min_m + box.max_m)));
}

Vector3d SlicePlane::seen(const Vector3d& p_W) const {
  const Vector3d d = p_W - origin_;
  return {out_.dot(d), side_.dot(d), d.z()};
}

bool SlicePlane::in_window(double out, double up, double margin_m) const {
  return std::abs(out - middle_.x()) < window_.reach_m + margin_m &&
         std::abs(up - middle_.z()) < window_.reach_m + margin_m;
}

bool SlicePlane::holds(const ReplaySphere& sphere) const {
  const Vector3d p = seen(sphere.p_m.cast<double>());
  return std::abs(p.y()) <= 0.5 * window_.thickness_m &&
         in_window(p.x(), p.z(), static_cast<double>(sphere.radius_m));
}

Slice slice(const ReplayFrame& frame, const std::vector<ReplayWall>& walls, std::size_t dipper,
            const SliceWindow& window) {
  const BodyState& state = frame.walls.at(dipper);
  const Pose& X_WB = state.X_WB;
  const SlicePlane plane(state, walls.at(dipper).mesh, window);

  Slice s;
  s.time_s = frame.time_s;
  const Pose X_BW = inverse(X_WB);
  std::vector<std::pair<double, SliceSphere>> found;
  for (const auto& sphere : frame.spheres) {
    if (!plane.holds(sphere)) continue;
    const Vector3d p_W = sphere.p_m.cast<double>();
    const Vector3d p = plane.seen(p_W);
    const auto r = static_cast<double>(sphere.radius_m);
    const Vector3d v_of_dipper = state.V_WB_W.v + state.V_WB_W.w.cross(Vector3d(p_W - X_WB.p));
    const double speed = (sphere.v_m_s.cast<double>() - v_of_dipper).norm();
    found.push_back({p.y(), {p.x(), p.z(), r, sphere.rock, speed, X_BW * p_W}});
  }
  // Seen from the right of the dipper, where out is to the right: the left side is far.
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& f : found) s.spheres.push_back(std::move(f.second));

  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Pose& X = frame.walls.at(w).X_WB;
    for (std::size_t k = 0; k < walls[w].mesh.triangles.size(); ++k) {
      auto corners = walls[w].mesh.corners(k);
      for (auto& c : corners) c = plane.seen(X * c);
      SliceSegment segment{};
      if (cut(corners, segment) && plane.in_window(segment.from[0], segment.from[1])) {
        s.walls.push_back(segment);
      }
    }
  }
  return s;
}

}  // namespace dipper::analysis::report
