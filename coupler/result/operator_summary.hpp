// What a planning operator achieved, for summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::result {

/// Read from the decisions and the record in a run's folder; null if nobody planned. Counts whole
/// passes only, up to the last dump: passes, stopped (the reason; null: not stopped), cycles_s
/// (from empty over the truck to empty again; none for the first pass, which begins in front of the
/// face), truck_kg, truck_s (all passes, the first with the others' mean way to the dig in place of
/// its own; null: there are no others), tonnes_per_hour (by truck_s), energy_J_per_kg (net work of
/// all drives by truck_kg: where a drive brakes, its work is negative)
nlohmann::ordered_json operator_summary(const cases::Case& c, const RunFolder& folder);

}  // namespace dipper::result
