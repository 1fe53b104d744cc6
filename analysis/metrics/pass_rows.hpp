// The figures of passes and phases with their names in files.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "analysis/metrics/pass_figures.hpp"

namespace dipper::analysis::metrics {

/// The columns of a pass and of a phase; unknown ones are left out.
nlohmann::ordered_json pass_row(const PassFigures& f);
nlohmann::ordered_json phase_row(const PhaseFigures& f);

/// passes[] of summary.json: each pass with its phases in it.
nlohmann::ordered_json nested_rows(const std::vector<PassFigures>& passes);

/// phases[] of metrics.json, a flat table: each phase with the number of its pass.
nlohmann::ordered_json phase_table(const std::vector<PassFigures>& passes);

}  // namespace dipper::analysis::metrics
