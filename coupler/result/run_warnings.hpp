// What a user has to see of a run before believing its figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::result {

/// The warnings about the case (coupler/check/warnings.hpp) and about its figures: a residual of
/// the energy, masses below nothing, peaks, slack ropes and forces that jump, as no dig's do.
/// \param summary  passes and coupling of summary.json
std::vector<std::string> run_warnings(const cases::Case& c, const nlohmann::ordered_json& summary);

}  // namespace dipper::result
