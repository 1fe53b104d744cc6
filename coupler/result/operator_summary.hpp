// What a planning operator achieved, for summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::result {

/// Read from the decisions and the record in a run's folder; null if nobody planned: passes,
/// stopped (the reason; null: not stopped), cycles_s (from empty over the truck to empty
/// again; none for the first pass, which begins in front of the face), truck_kg, truck_s (all
/// passes, each with a return), tonnes_per_hour, energy_J_per_kg (of the drives, by the mass in the
/// truck)
nlohmann::ordered_json operator_summary(const cases::Case& c, const RunFolder& folder);

}  // namespace dipper::result
