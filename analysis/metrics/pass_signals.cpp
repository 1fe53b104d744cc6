#include "analysis/metrics/pass_signals.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/signals/time_mean.hpp"
#include "common/gravity.hpp"
#include "machine/door.hpp"

namespace dipper::analysis::metrics {
namespace {

constexpr double kStill_m_s = 0.05;

}  // namespace

Effort effort(const run::RunSignals& s, double t_start_s, double t_end_s) {
  const auto& t = s.pass.time_s;
  const auto rows = signals::rows_within(t, t_start_s, t_end_s);
  Effort e;
  if (!rows) return e;
  const std::size_t a = rows->first, b = rows->last;
  const auto force = [&](std::size_t i) {
    return std::hypot(s.pass.crowd_force_N[i], s.pass.hoist_force_N[i]);
  };
  const auto integral = [&](auto value) {
    double sum = 0;
    for (std::size_t i = a; i < b; ++i) sum += 0.5 * (value(i) + value(i + 1)) * (t[i + 1] - t[i]);
    return sum;
  };
  e.dig_force_mean_N = integral(force) / (t[b] - t[a]);
  for (std::size_t i = a; i <= b; ++i) e.dig_force_peak_N = std::max(e.dig_force_peak_N, force(i));
  e.drives = signals::drives_work(s.drive, t_start_s, t_end_s);
  e.rock_work_J = rows->share * (s.rock_work_J[b] - s.rock_work_J[a]);
  e.mass_gain_kg = rows->share * (s.pass.dipper_mass_kg[b] - s.pass.dipper_mass_kg[a]);
  return e;
}

std::optional<StaticWeight> static_weight(const run::RunSignals& s, const signals::Pass& pass) {
  const auto& t = s.pass.time_s;
  const rock::PoseTrack& dipper = s.walls.at("dipper");
  StaticWeight w;
  double sum = 0;
  std::size_t still = 0, all = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (t[i] < pass.t_dump_s - signals::kPayloadWindow_s || t[i] > pass.t_dump_s) continue;
    ++all;
    if (!machine::door_is_latched(s.pass.door_rad[i])) continue;
    if (std::abs(dipper.at(t[i]).V_WB_W.v.z()) > kStill_m_s) continue;
    if (still == 0) w.from_s = t[i];
    w.to_s = t[i];
    sum += s.weight_N[i];
    ++still;
  }
  if (still == 0 || 2 * still < all) return std::nullopt;
  w.mass_kg = sum / static_cast<double>(still) / kGravity_m_s2;
  return w;
}

}  // namespace dipper::analysis::metrics
