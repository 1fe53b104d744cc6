// What a pass is, and what its drives tell, under the names that metrics.json and summary.json
// share.
#pragma once

#include <nlohmann/json.hpp>

#include "analysis/run/run_folder.hpp"
#include "analysis/signals/drive_work.hpp"
#include "analysis/signals/machine_demand.hpp"
#include "analysis/signals/payload_monitor.hpp"

namespace dipper::analysis::run {

/// pass, its times (t_start_s, t_dig_s, t_dump_s, t_end_s), dumped, payload_kg, truck_kg.
nlohmann::ordered_json pass_row(const signals::Pass& p);

/// hoist_work_J, hoist_power_mean_W, hoist_power_peak_W, and so for crowd and swing.
void put_work(nlohmann::ordered_json& row, const signals::DrivesWork& work);

/// dig_work_J and, with a payload, specific_dig_energy_J_kg; of a pass without a dig nothing.
void put_dig_energy(nlohmann::ordered_json& row, const RunSignals& s,
                    const signals::PassPhases& pass);

/// monitor_payload_kg, monitor_inside_kg (what the dipper held meanwhile), monitor_from_s,
/// monitor_to_s, monitor_at_rest; of a pass the monitor does not weigh nothing.
void put_monitor(nlohmann::ordered_json& row, const RunSignals& s, const signals::PassPhases& pass,
                 const signals::PayloadMonitor& monitor);

/// teeth_deviation_m, hoist_beyond_share, crowd_beyond_share.
void put_demand(nlohmann::ordered_json& row, const signals::Demand& demand);

}  // namespace dipper::analysis::run
