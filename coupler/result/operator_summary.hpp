// What an operator who plans got done, for summary.json.
#pragma once

#include <nlohmann/json.hpp>

#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::result {

/// Of the decisions and the record in a run's folder; null where nobody planned:
///   passes, stopped (why; null: he has not), cycles_s (from the dipper empty over the truck to
///   the next time; the first pass, which begins in front of the face, is none), truck_kg,
///   truck_s (all passes with a way back each),
///   tonnes_per_hour, energy_J_per_kg (of the drives, by what is in the truck)
nlohmann::ordered_json operator_summary(const cases::Case& c, const RunFolder& folder);

}  // namespace dipper::result
