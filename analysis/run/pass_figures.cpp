#include "analysis/run/pass_figures.hpp"

#include <string>
#include <utility>

namespace dipper::analysis::run {

using json = nlohmann::ordered_json;

json pass_row(const signals::Pass& p) {
  return {{"pass", p.pass},
          {"t_start_s", p.t_start_s},
          {"t_dig_s", p.t_dig_s},
          {"t_dump_s", p.t_dump_s},
          {"t_end_s", p.t_end_s},
          {"dumped", p.dumped},
          {"payload_kg", p.payload_kg},
          {"truck_kg", p.truck_kg}};
}

void put_work(json& row, const signals::DrivesWork& work) {
  for (const auto& [name, drive] :
       {std::pair{"hoist", &work.hoist}, {"crowd", &work.crowd}, {"swing", &work.swing}}) {
    row[std::string(name) + "_work_J"] = drive->work_J;
    row[std::string(name) + "_power_mean_W"] = drive->power_mean_W;
    row[std::string(name) + "_power_peak_W"] = drive->power_peak_W;
  }
}

void put_dig_energy(json& row, const RunSignals& s, const signals::PassPhases& pass) {
  const auto energy = signals::dig_energy(s.drive, pass);
  if (!energy) return;
  row["dig_work_J"] = energy->work_J;
  if (energy->specific_J_kg) row["specific_dig_energy_J_kg"] = *energy->specific_J_kg;
}

void put_monitor(json& row, const RunSignals& s, const signals::PassPhases& pass,
                 const signals::PayloadMonitor& monitor) {
  const auto reading = monitor.weigh(s.drive, s.pass.door_rad, pass);
  if (!reading) return;
  double inside_kg = 0;
  for (const std::size_t i : reading->rows) inside_kg += s.pass.dipper_mass_kg[i];
  row["monitor_payload_kg"] = reading->mass_kg;
  row["monitor_inside_kg"] = inside_kg / static_cast<double>(reading->rows.size());
  row["monitor_from_s"] = reading->from_s;
  row["monitor_to_s"] = reading->to_s;
  row["monitor_at_rest"] = reading->at_rest;
}

void put_demand(json& row, const signals::Demand& demand) {
  row["teeth_deviation_m"] = demand.teeth_deviation_m;
  row["hoist_beyond_share"] = demand.hoist_beyond_share;
  row["crowd_beyond_share"] = demand.crowd_beyond_share;
}

}  // namespace dipper::analysis::run
