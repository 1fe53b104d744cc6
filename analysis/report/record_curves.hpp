// The curves of the report, from a run's record.
#pragma once

#include "analysis/report/report_page.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::report {

/// Fills `time_s` and `curves`: rock and coupling; of a shovel its drives and "dig_force" [N], the
/// paper's Eq. 11, and of limited drives the times at their limit, and "late" [s], time less
/// the motion's. Of other machines "force/BODY" [N], the rock's force on each body, and the mass in
/// each body that has a weighed region. Throws InputError naming file and dataset.
void read_curves(const run::RunData& run, ReportInput& input);

}  // namespace dipper::analysis::report
