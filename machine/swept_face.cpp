#include "machine/swept_face.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/door.hpp"
#include "machine/return_legs.hpp"

namespace dipper::machine {
namespace {

constexpr double kSweptStep_m = 0.05;
constexpr double kTurned_rad = 0.03;  // 0.6 m at 20 m: the boom has left the dig's plane
constexpr double kStill_rad_s = 1e-3;
constexpr double kSameLane_rad = 0.1;
constexpr std::int64_t kTick_ns = 20'000'000;

/// A surface as heights over equal steps of x.
class Surface {
 public:
  explicit Surface(const TeethPath& face) {
    std::size_t i = 1;
    for (double x = 0; x < face.back().x(); x += kSweptStep_m) {
      while (i + 1 < face.size() && face[i].x() < x) ++i;
      const Vector2d &a = face[i - 1], &b = face[i];
      const double share = b.x() > a.x() ? std::clamp((x - a.x()) / (b.x() - a.x()), 0.0, 1.0) : 1;
      z_.push_back(a.y() + share * (b.y() - a.y()));
    }
  }

  /// Removes everything above the straight line between two points.
  void cut(const Vector2d& from, const Vector2d& to, SweptPass& pass) {
    const auto [low, high] = std::minmax(from.x(), to.x());
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(low / kSweptStep_m)));
    for (std::size_t k = first; k < z_.size() && static_cast<double>(k) * kSweptStep_m <= high;
         ++k) {
      const double x = static_cast<double>(k) * kSweptStep_m;
      const double share = to.x() != from.x() ? (x - from.x()) / (to.x() - from.x()) : 1;
      const double depth = z_[k] - (from.y() + share * (to.y() - from.y()));
      if (depth <= 0) continue;
      z_[k] -= depth;
      pass.area_m2 += depth * kSweptStep_m;
      pass.deepest_m = std::max(pass.deepest_m, depth);
    }
  }

 private:
  std::vector<double> z_;
};

}  // namespace

std::vector<SweptPass> swept_passes(const Motion& motion, const ShovelKinematics& shovel,
                                    const std::function<TeethPath(double heading_rad)>& face) {
  std::vector<std::int64_t> starts = {motion.start_ns()};
  for (const ReturnLeg& leg : return_legs(motion))
    if (leg.end_ns < motion.end_ns()) starts.push_back(leg.end_ns);
  std::vector<std::pair<double, Surface>> lanes;
  std::vector<SweptPass> passes;
  for (const std::int64_t start : starts) {
    SweptPass pass;
    pass.t_start_s = seconds(start);
    // The boom may still be moving to the dig, or only begin to: a stand without a cut is no dig.
    std::int64_t t = start;
    bool opens = false;
    while (pass.area_m2 == 0 && t < motion.end_ns() && !opens) {
      while (t < motion.end_ns() && std::abs(motion.rate(t).swing) > kStill_rad_s) t += kTick_ns;
      const double heading = motion.value(t).swing;
      const auto known = std::find_if(lanes.begin(), lanes.end(), [&](const auto& lane) {
        return std::abs(lane.first - heading) < kSameLane_rad;
      });
      Surface surface = known == lanes.end() ? Surface(face(heading)) : known->second;
      Vector2d last = shovel.teeth(motion.value(t));
      for (t += kTick_ns; t < motion.end_ns(); t += kTick_ns) {
        const Drives d = motion.value(t);
        opens = door_is_open(d.door) && motion.rate(t).door > 0;
        if (std::abs(d.swing - heading) > kTurned_rad || opens) break;
        const Vector2d tip = shovel.teeth(d);
        surface.cut(last, tip, pass);
        last = tip;
      }
      if (pass.area_m2 == 0) continue;
      pass.first = known == lanes.end();
      if (pass.first)
        lanes.emplace_back(heading, std::move(surface));
      else
        known->second = std::move(surface);
    }
    passes.push_back(pass);
  }
  return passes;
}

}  // namespace dipper::machine
