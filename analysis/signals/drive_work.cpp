#include "analysis/signals/drive_work.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/signals/time_mean.hpp"

namespace dipper::analysis::signals {
namespace {

DriveWork work_between(const std::vector<double>& time_s, const std::vector<double>& power_W,
                       double t_start_s, double t_end_s) {
  if (power_W.size() != time_s.size())
    throw std::invalid_argument("powers and times differ in number");
  const auto rows = rows_within(time_s, t_start_s, t_end_s);
  DriveWork w;
  if (!rows) return w;
  const auto [a, b, share] = *rows;
  w.power_peak_W = power_W[a];
  for (std::size_t i = a; i < b; ++i) {
    w.work_J += 0.5 * (power_W[i] + power_W[i + 1]) * (time_s[i + 1] - time_s[i]);
    w.power_peak_W = std::max(w.power_peak_W, power_W[i + 1]);
  }
  w.power_mean_W = w.work_J / (time_s[b] - time_s[a]);
  w.work_J *= share;
  return w;
}

}  // namespace

DrivesWork drives_work(const DriveSignals& s, double t_start_s, double t_end_s) {
  const auto of = [&](const std::vector<double>& power_W) {
    return work_between(s.time_s, power_W, t_start_s, t_end_s);
  };
  return {of(s.hoist_power_W), of(s.crowd_power_W), of(s.swing_power_W)};
}

std::optional<DigEnergy> dig_energy(const DriveSignals& s, const PassPhases& pass) {
  const auto dig = pass.dig();
  if (!dig) return std::nullopt;
  const DrivesWork w = drives_work(s, dig->t_start_s, dig->t_end_s);
  DigEnergy e;
  e.work_J = w.hoist.work_J + w.crowd.work_J;
  if (pass.pass.payload_kg > 0) e.specific_J_kg = e.work_J / pass.pass.payload_kg;
  return e;
}

}  // namespace dipper::analysis::signals
