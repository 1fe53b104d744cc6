#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/seconds.hpp"
#include "coupler/check/check_parts.hpp"

namespace dipper::check {
namespace {

// Between two samples a tooth at 5 m/s (full swing) moves 0.1 m, but where it is farthest out it
// turns back: there the error is 1/8 of acceleration times the sample squared, below a millimetre.
constexpr std::int64_t kSample_ns = 20'000'000;

// How far one body has been outside of one side of the domain.
struct Excursion {
  double first_s = -1;  // -1: never
  double worst_s = 0;
  double worst = 0;  // coordinate, m
  double beyond = 0;

  void see(double coordinate, double outside_by, double t_s) {
    if (outside_by <= 0) return;
    if (first_s < 0) first_s = t_s;
    if (outside_by <= beyond) return;
    worst_s = t_s;
    worst = coordinate;
    beyond = outside_by;
  }
};

// A body's box, for the corners that are far from every side most of the time.
using Corners = std::array<Eigen::Vector3d, 8>;

Corners corners_of(const mesh::TriangleMesh& body) {
  const Box box = mesh::bounding_box(body);
  Corners corners;
  for (std::size_t k = 0; k < corners.size(); ++k)
    corners[k] = {(k & 1U ? box.max_m : box.min_m).x(), (k & 2U ? box.max_m : box.min_m).y(),
                  (k & 4U ? box.max_m : box.min_m).z()};
  return corners;
}

// Whether a body in a box can be farther outside than it has been.
bool may_be_farther(const std::array<Excursion, 6>& sides, const Box& box_W, const Box& domain) {
  for (int i = 0; i < 3; ++i)
    if (domain.min_m[i] - box_W.min_m[i] > sides[i].beyond ||
        box_W.max_m[i] - domain.max_m[i] > sides[i + 3].beyond)
      return true;
  return false;
}

}  // namespace

void check_bodies_in_domain(const cases::Case& c, const PoseAt& pose_at, std::int64_t start_ns,
                            std::int64_t end_ns,
                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                            Findings& findings) {
  std::map<std::string, std::array<Excursion, 6>> excursions;  // xyz of min_m, then of max_m
  std::map<std::string, Corners> corners;
  for (const auto& [name, body] : bodies) corners[name] = corners_of(body);
  const Box domain{c.domain.min_m, c.domain.max_m};
  for (std::int64_t t = start_ns;; t = std::min(t + kSample_ns, end_ns)) {
    for (const auto& [name, body] : bodies) {
      const std::optional<Pose> pose = pose_at(name, t);
      if (!pose) continue;
      const Pose& X = *pose;
      const Eigen::Matrix3d R = X.R.toRotationMatrix();
      Box box_W;
      for (const Eigen::Vector3d& p_B : corners[name]) box_W.add(X.p + R * p_B);
      auto& sides = excursions[name];
      if (!may_be_farther(sides, box_W, domain)) continue;
      for (const Eigen::Vector3d& p_B : body.vertices) {
        const Eigen::Vector3d p_W = X.p + R * p_B;
        for (int i = 0; i < 3; ++i) {
          sides[i].see(p_W[i], c.domain.min_m[i] - p_W[i], seconds(t));
          sides[i + 3].see(p_W[i], p_W[i] - c.domain.max_m[i], seconds(t));
        }
      }
    }
    if (t == end_ns) break;
  }
  for (const auto& [name, sides] : excursions) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Excursion& e = sides[i];
      if (e.first_s < 0) continue;
      const bool low = i < 3;
      findings.push_back(cases::finding_at(
          c, low ? "domain.min_m" : "domain.max_m",
          fmt::format("the {} leaves the domain at {:.2f} s; at {:.2f} s it reaches {} = {:.4g} m, "
                      "{:.3g} m outside {:g}",
                      name, e.first_s, e.worst_s, "xyz"[i % 3], e.worst, e.beyond,
                      (low ? c.domain.min_m : c.domain.max_m)[static_cast<int>(i % 3)])));
    }
  }
}

}  // namespace dipper::check
