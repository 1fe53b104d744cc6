// Warnings about a run's figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::result {

/// The warnings about the case (coupler/check/warnings.hpp) and about its figures: residual energy,
/// negative masses, and peaks, slack ropes and jumping forces beyond those of a sound dig.
/// \param summary  passes and coupling of summary.json
std::vector<std::string> run_warnings(const cases::Case& c, const nlohmann::ordered_json& summary);

}  // namespace dipper::result
