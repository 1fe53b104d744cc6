#include "analysis/metrics/pass_rows.hpp"

#include <string>
#include <utility>

namespace dipper::analysis::metrics {

using json = nlohmann::ordered_json;

namespace {

void put(json& row, const char* key, const std::optional<double>& value) {
  if (value) row[key] = *value;
}

void put_demand(json& row, const std::optional<signals::Demand>& demand) {
  if (!demand) return;
  row["teeth_deviation_m"] = demand->teeth_deviation_m;
  row["hoist_beyond_fraction"] = demand->hoist_beyond_fraction;
  row["crowd_beyond_fraction"] = demand->crowd_beyond_fraction;
}

}  // namespace

json pass_row(const PassFigures& f) {
  const signals::Pass& p = f.found.pass;
  json row = {{"pass", p.pass},
              {"t_start_s", p.t_start_s},
              {"t_dig_s", p.t_dig_s},
              {"t_dump_s", p.t_dump_s},
              {"t_end_s", p.t_end_s},
              {"dumped", p.dumped},
              {"payload_kg", p.payload_kg},
              {"truck_kg", p.truck_kg}};
  put(row, "fill_factor", f.fill_factor);
  put(row, "fill_factor_load", f.fill_factor_load);
  row["dig_force_mean_N"] = p.dig_force_mean_N;
  row["dig_force_peak_N"] = p.dig_force_peak_N;
  row["dig_force_peak_t_s"] = p.dig_force_peak_t_s;
  put(row, "dig_phases_force_mean_N", f.found.dig_phases_force_mean_N);
  put(row, "dig_slack_fraction", f.found.dig_slack_fraction);
  put_demand(row, f.dig_demand);
  put(row, "dig_rattle_fraction", f.dig_rattle_fraction);
  if (f.dig_energy) {
    row["dig_work_J"] = f.dig_energy->work_J;
    put(row, "specific_dig_energy_J_kg", f.dig_energy->specific_J_kg);
  }
  if (f.monitor) {
    row["monitor_payload_kg"] = f.monitor->reading.mass_kg;
    row["monitor_inside_kg"] = f.monitor->inside_kg;
    row["monitor_from_s"] = f.monitor->reading.from_s;
    row["monitor_to_s"] = f.monitor->reading.to_s;
    row["monitor_at_rest"] = f.monitor->reading.at_rest;
  }
  return row;
}

json phase_row(const PhaseFigures& f) {
  json row = {{"phase", word(f.phase.name)},
              {"t_start_s", f.phase.t_start_s},
              {"t_end_s", f.phase.t_end_s},
              {"dig_force_mean_N", f.effort.dig_force_mean_N},
              {"dig_force_peak_N", f.effort.dig_force_peak_N},
              {"rock_work_J", f.effort.rock_work_J},
              {"mass_gain_kg", f.effort.mass_gain_kg},
              {"slack_fraction", f.slack_fraction}};
  put_demand(row, f.demand);
  if (f.limits) row.update(json_of(*f.limits));
  const signals::DrivesWork& work = f.effort.drives;
  for (const auto& [name, drive] :
       {std::pair{"hoist", &work.hoist}, {"crowd", &work.crowd}, {"swing", &work.swing}}) {
    row[std::string(name) + "_work_J"] = drive->work_J;
    row[std::string(name) + "_power_mean_W"] = drive->power_mean_W;
    row[std::string(name) + "_power_peak_W"] = drive->power_peak_W;
  }
  return row;
}

json nested_rows(const std::vector<PassFigures>& passes) {
  json out = json::array();
  for (const PassFigures& f : passes) {
    json row = pass_row(f);
    json& phases = row["phases"] = json::array();
    for (const PhaseFigures& phase : f.phases) phases.push_back(phase_row(phase));
    out.push_back(std::move(row));
  }
  return out;
}

json phase_table(const std::vector<PassFigures>& passes) {
  json out = json::array();
  for (const PassFigures& f : passes)
    for (const PhaseFigures& phase : f.phases) {
      json row = {{"pass", f.found.pass.pass}};
      row.update(phase_row(phase));
      out.push_back(std::move(row));
    }
  return out;
}

}  // namespace dipper::analysis::metrics
