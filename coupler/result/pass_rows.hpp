// A run's passes, as summary.json has them.
#pragma once

#include <nlohmann/json.hpp>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::result {

/// One row for each pass in the record of a run's folder; the load's density is from its dumps.
/// Throws std::runtime_error naming file and dataset.
nlohmann::ordered_json pass_rows(const cases::Case& c, const RunFolder& folder);

/// One line for each pass.
void report_passes(const nlohmann::ordered_json& passes, Reporter& reporter);

}  // namespace dipper::result
