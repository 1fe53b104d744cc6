#include "analysis/metrics/pass_figures.hpp"

#include <utility>

#include "common/record/record.hpp"

namespace dipper::analysis::metrics {
namespace {

constexpr double kJump = 0.3;  // of the dig's mean force, from one step to the next

std::optional<MonitorFigures> read_monitor(const signals::PayloadMonitor& monitor,
                                           const run::RunSignals& s,
                                           const signals::PassPhases& pass) {
  const auto reading = monitor.weigh(s.drive, s.pass.door_rad, pass);
  if (!reading) return std::nullopt;
  double sum = 0;
  for (const std::size_t i : reading->rows) sum += s.pass.dipper_mass_kg[i];
  return MonitorFigures{*reading, sum / static_cast<double>(reading->rows.size())};
}

}  // namespace

PassFigureMaker::PassFigureMaker(const run::RunSignals& signals,
                                 const std::filesystem::path& record, Known known)
    : signals_(signals), known_(std::move(known)), rattle_(record) {
  if (known_.limited_drives) limits_.emplace(record);
  if (!known_.machine) return;
  monitor_.emplace(*known_.machine, known_.rake_rad);
  demand_.emplace(*known_.machine, known_.rake_rad,
                  record::read_channel(record, "machine/saddle_pitch"));
}

PassFigures PassFigureMaker::figures(const signals::PassPhases& pass,
                                     const std::optional<LoadInDipper>& load) const {
  PassFigures f;
  f.found = pass;
  f.load = load;
  const auto fill = [&](double density_kg_m3) -> std::optional<double> {
    const double full_kg = known_.struck_volume_m3 * density_kg_m3;
    if (full_kg <= 0) return std::nullopt;
    return pass.pass.payload_kg / full_kg;
  };
  f.fill_factor = fill(known_.bulk_density_kg_m3);
  if (load) f.fill_factor_load = fill(load->bulk_density_kg_m3());
  if (const auto dig = pass.dig()) {
    f.dig_demand = demand(*dig);
    if (pass.pass.dig_force_mean_N > 0)  // else it meets no rock
      f.dig_rattle_fraction = rattle_.share(*dig, kJump * pass.pass.dig_force_mean_N);
  }
  f.dig_energy = signals::dig_energy(signals_.drive, pass);
  if (monitor_) f.monitor = read_monitor(*monitor_, signals_, pass);
  for (const signals::Phase& phase : pass.phases) f.phases.push_back(of_phase(phase));
  return f;
}

PhaseFigures PassFigureMaker::of_phase(const signals::Phase& phase) const {
  return {phase, effort(signals_, phase.t_start_s, phase.t_end_s),
          signals::slack_fraction(signals_.pass, phase.t_start_s, phase.t_end_s), demand(phase),
          limits_ ? std::optional(limits_->over(phase)) : std::nullopt};
}

std::optional<signals::Demand> PassFigureMaker::demand(const signals::TimeSpan& time) const {
  if (!demand_) return std::nullopt;
  return demand_->over(signals_.drive, signals_.pass.rope_tension_N, time.t_start_s, time.t_end_s);
}

}  // namespace dipper::analysis::metrics
