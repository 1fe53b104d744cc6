#include "analysis/signals/payload_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/gravity.hpp"
#include "machine/kinematics.hpp"
#include "machine/sheave_path.hpp"

namespace dipper::analysis::signals {
namespace {

using machine::Vector2d;

constexpr double kStands_m_s = 0.1;
constexpr double kShortest_s = 0.5;      // below, the drives never stood
constexpr double kHalf_s = 0.25;         // of the time over which speeds are taken
constexpr double kLatched_rad = 1e-5;    // beyond, the door gives way
constexpr double kFewest_share = 1e-12;  // of g^2: a load that neither balance shows

Vector2d in_plane(const Vector3d& p) { return {p.x(), p.z()}; }

/// x out, z up: positive lifts the handle.
double moment(const Vector2d& arm, const Vector2d& force) {
  return arm.x() * force.y() - arm.y() * force.x();
}

/// How fast a signal changes about a reading.
double speed_at(const std::vector<double>& time_s, const std::vector<double>& x, std::size_t i) {
  const auto at = [&](double t) {
    const auto it = std::lower_bound(time_s.begin(), time_s.end(), t);
    return std::min(static_cast<std::size_t>(it - time_s.begin()), time_s.size() - 1);
  };
  const std::size_t a = at(time_s[i] - kHalf_s), b = at(time_s[i] + kHalf_s);
  return b > a ? (x[b] - x[a]) / (time_s[b] - time_s[a]) : 0;
}

/// What two balances lack, in force of hoist and of crowd [N], and what a kilogram of load makes
/// up.
struct Balances {
  Vector2d lack, of_a_kg;
  double rope_out = 0;  ///< of the hoist's force, along the handle
};

Balances balances(const machine::MachineData& m, const machine::ShovelKinematics& shovel,
                  const machine::Drives& at, double hoist_N, double crowd_N, double swing_rad_s) {
  const machine::ShovelPose X = shovel.pose(at);
  const Vector2d saddle = in_plane(m.saddle.position);
  const Vector2d out(std::cos(X.saddle), std::sin(X.saddle));
  const auto pull = [&](const Vector2d& p) {  // on a kilogram there
    return Vector2d(swing_rad_s * swing_rad_s * p.x(), -kGravity_m_s2);
  };
  const Vector2d bail = in_plane(X.X_WB * m.dipper.bail), point = in_plane(m.boom.point);
  const Vector2d rope =
      machine::sheave_path(in_plane(m.rope.drum) - point, bail - point, m.boom.sheave_radius)
          .toward_b;
  const double arm = moment(bail - saddle, rope);
  const auto carried = [&](const Vector2d& p) {
    return Vector2d(moment(p - saddle, pull(p)) / arm, pull(p).dot(out));
  };
  Balances b;
  b.rope_out = rope.dot(out);
  b.lack = {hoist_N, crowd_N + hoist_N * b.rope_out};
  const Vector2d end = in_plane(X.X_WB * m.dipper.handle_end);
  b.lack += m.handle.mass * carried(end + m.handle.mass_center * out);
  b.lack += m.dipper.mass * carried(in_plane(X.X_WB * m.dipper.mass_center));
  b.lack += m.door.mass * carried(in_plane(X.X_WD * m.door.mass_center));
  b.of_a_kg = -carried(in_plane(X.X_WB * Vector3d(m.dipper.inside.x() / 2, 0, 0)));
  return b;
}

}  // namespace

std::optional<PayloadMonitor::ForceOfAKg> PayloadMonitor::force_of_a_kg(double hoist_m,
                                                                        double crowd_m) const {
  try {
    const machine::ShovelKinematics shovel(machine_, Pose{}, rake_);
    const Balances b = balances(machine_, shovel, {hoist_m, crowd_m, 0, 0}, 0, 0, 0);
    return ForceOfAKg{b.of_a_kg.x(), b.of_a_kg.y() - b.of_a_kg.x() * b.rope_out};
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

std::optional<MonitorReading> PayloadMonitor::weigh(const DriveSignals& s,
                                                    const std::vector<double>& door_rad,
                                                    const PassPhases& pass) const {
  const Phase* swing = pass.phase(PhaseName::swing);
  if (swing == nullptr || !pass.pass.dumped) return std::nullopt;
  const auto& t = s.time_s;
  std::vector<std::size_t> all, still;
  double still_s = 0;
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] < swing->t_start_s || t[i] > pass.pass.t_dump_s) continue;
    if (std::abs(door_rad[i]) > kLatched_rad) continue;
    all.push_back(i);
    if (std::abs(speed_at(t, s.hoist_m, i)) > kStands_m_s) continue;
    if (std::abs(speed_at(t, s.crowd_m, i)) > kStands_m_s) continue;
    still.push_back(i);
    still_s += t[i] - t[i - 1];
  }
  MonitorReading reading;
  reading.at_rest = still_s >= kShortest_s;
  const machine::ShovelKinematics shovel(machine_, Pose{}, rake_);
  double sum = 0, weight = 0;
  for (const std::size_t i : reading.at_rest ? still : all) {
    try {
      const Balances b =
          balances(machine_, shovel, {s.hoist_m[i], s.crowd_m[i], 0, 0}, s.hoist_force_N[i],
                   s.crowd_force_N[i], speed_at(t, s.swing_rad, i));
      sum += b.of_a_kg.dot(b.lack);
      weight += b.of_a_kg.squaredNorm();
      reading.rows.push_back(i);
    } catch (const std::domain_error&) {  // the ropes hang slack where no taut ones would reach
    }
  }
  if (weight <= kFewest_share) return std::nullopt;
  reading.mass_kg = sum / weight;
  reading.from_s = t[reading.rows.front()];
  reading.to_s = t[reading.rows.back()];
  return reading;
}

}  // namespace dipper::analysis::signals
