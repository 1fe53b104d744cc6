#include "coupler/run/summary.hpp"

#include <cmath>

#include "analysis/signals/pass_phases.hpp"
#include "common/record/record.hpp"
#include "common/version.hpp"

namespace dipper::run {
analysis::signals::PassSignals read_pass_signals(const std::filesystem::path& record) {
  analysis::signals::PassSignals s;
  s.time_s = record::read_channel(record, "time_s");
  s.door_rad = record::read_channel(record, "machine/door");
  s.hoist_force_N = record::read_channel(record, "machine/hoist_force");
  s.crowd_force_N = record::read_channel(record, "machine/crowd_force");
  s.dipper_mass_kg = record::read_channel(record, "rock/mass_in_dipper");
  s.truck_mass_kg = record::read_channel(record, "rock/mass_in_truck");
  const auto fx = record::read_channel(record, "bodies/dipper/wrench_mean", 3);
  const auto fy = record::read_channel(record, "bodies/dipper/wrench_mean", 4);
  const auto fz = record::read_channel(record, "bodies/dipper/wrench_mean", 5);
  for (std::size_t i = 0; i < fx.size(); ++i) {
    s.dipper_force_N.push_back(std::hypot(fx[i], fy[i], fz[i]));
  }
  return s;
}

nlohmann::ordered_json summarise(const RunFacts& f, const std::filesystem::path& record) {
  using json = nlohmann::ordered_json;
  const analysis::signals::PassSignals signals = read_pass_signals(record);
  json passes = json::array();
  analysis::signals::DriveSignals drive;
  drive.time_s = signals.time_s;
  drive.crowd_m = record::read_channel(record, "machine/crowd");
  drive.swing_rad = record::read_channel(record, "machine/swing");
  for (const auto& found : analysis::signals::find_pass_phases(signals, drive)) {
    const auto& p = found.pass;
    json row = {{"pass", p.pass},
                {"t_start_s", p.t_start_s},
                {"t_dig_s", p.t_dig_s},
                {"t_dump_s", p.t_dump_s},
                {"t_end_s", p.t_end_s},
                {"payload_kg", p.payload_kg},
                {"truck_kg", p.truck_kg},
                {"fill_factor", p.payload_kg / (f.bulk_density_kg_m3 * f.struck_volume_m3)},
                {"dig_force_mean_N", p.dig_force_mean_N},
                {"dig_force_peak_N", p.dig_force_peak_N}};
    if (found.dig_phases_force_mean_N)
      row["dig_phases_force_mean_N"] = *found.dig_phases_force_mean_N;
    passes.push_back(row);
  }
  const double sim_s = signals.time_s.empty() ? 0.0 : signals.time_s.back();
  const double cpu_s = f.dem_cpu_s + f.mbs_cpu_s;
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  json out = {
      {"case", f.case_name},
      {"seed", f.seed},
      {"version", version()},
      {"status", f.status},
      {"effects", f.effects},
      {"passes", passes},
      {"coupling",
       {{"scheme", f.scheme},
        {"syncs", f.syncs},
        {"sync_step_mean_s", ratio(sim_s, static_cast<double>(f.syncs))},
        {"overhead_fraction", ratio(f.wall_s - f.rock_wait_s, f.wall_s)},
        {"energy_residual_J", f.energy_residual_J},
        {"interface_work_J", f.interface_work_J},
        {"resends", f.resends},
        {"foreign_messages", f.foreign_messages}}},
      {"dem",
       {{"particles", f.particles},
        {"bodies", f.bodies},
        {"timestep_s", f.timestep_s},
        {"steps", f.dem_steps},
        {"cpu_s", f.dem_cpu_s},
        {"wall_s", f.wall_s},
        {"particle_steps_per_cpu_s",
         ratio(static_cast<double>(f.particles) * static_cast<double>(f.dem_steps), f.dem_cpu_s)}}},
      {"mbs", {{"cpu_s", f.mbs_cpu_s}, {"realtime_factor", ratio(sim_s, f.mbs_cpu_s)}}},
      {"sim_s", sim_s},
      {"cpu_s_per_sim_s", ratio(cpu_s, sim_s)},
      {"state_hash", f.state_hash}};
  if (!f.failure.empty()) out["failure"] = f.failure;
  return out;
}

}  // namespace dipper::run
