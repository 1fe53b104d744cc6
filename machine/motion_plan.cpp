#include "machine/motion_plan.hpp"

#include <algorithm>
#include <cmath>

#include "machine/motion_row.hpp"

namespace dipper::machine {
namespace {

/// The path of the teeth in one pass: out through the rock and up to the dump, and back down.
struct Way {
  TeethPath out, back;
};

Way way(const MotionPlan& plan, std::size_t pass) {
  TeethPath out = plan.passes[pass].dig;
  out.insert(out.end(), plan.lift.begin(), plan.lift.end());
  Way w{spline(out), {}};
  if (!plan.returns) return w;
  TeethPath back(1, plan.lift.back());
  back.insert(back.end(), plan.lower.begin(), plan.lower.end());
  back.push_back(plan.passes[(pass + 1) % plan.passes.size()].dig.front());
  w.back = spline(back);
  return w;
}

}  // namespace

double Move::share(double t_s) const {
  const double span = end_s - start_s;
  const double tau = std::clamp(t_s - start_s, 0.0, span);
  // Distance at unit speed, `x` after the speed begins to rise.
  const auto risen = [&](double x) {
    return ramp_s > 0 ? x / 2 - ramp_s / (2 * M_PI) * std::sin(M_PI * x / ramp_s) : 0.0;
  };
  const double up = risen(std::min(tau, ramp_s));
  const double middle = std::clamp(tau - ramp_s, 0.0, span - 2 * ramp_s);
  const double down = ramp_s / 2 - risen(ramp_s - std::max(tau - (span - ramp_s), 0.0));
  return (up + middle + down) / (span - ramp_s);
}

std::string motion_rows(const MotionPlan& plan, const ShovelKinematics& shovel) {
  std::vector<Way> ways;
  for (std::size_t k = 0; k < plan.passes.size(); ++k) ways.push_back(way(plan, k));
  const double end_s = plan.cycle_s * static_cast<double>(plan.passes.size());
  std::string rows;
  for (int i = 0; i * plan.sample_s <= end_s + 1e-9; ++i) {
    const double t = i * plan.sample_s;
    const auto pass =
        std::min(static_cast<std::size_t>((t + 1e-9) / plan.cycle_s), plan.passes.size() - 1);
    const double tau = t - static_cast<double>(pass) * plan.cycle_s;
    const bool homeward = plan.returns && tau >= plan.back.start_s;
    const Vector2d tip = homeward ? at_fraction(ways[pass].back, plan.back.share(tau))
                                  : at_fraction(ways[pass].out, plan.dig.share(tau));
    const double heading = plan.passes[pass].heading_rad;
    double swing = heading + (plan.dump_rad - heading) * plan.swing_out.share(tau);
    double door = plan.door_rad * plan.door_open.share(tau);
    if (plan.returns) {
      const double next = plan.passes[(pass + 1) % plan.passes.size()].heading_rad;
      swing += (next - plan.dump_rad) * plan.swing_back.share(tau);
      door -= plan.door_rad * plan.door_close.share(tau);
    }
    rows += motion_row(t, tip, swing, door, shovel);
  }
  return rows;
}

}  // namespace dipper::machine
