// The curves of the report, from a run's record.
#pragma once

#include "analysis/report/report_page.hpp"

namespace dipper::analysis::report {

/// Fills `time_s` and `curves`: drives, rock and coupling, and "dig_force" [N], the paper's Eq. 11;
/// of limited drives where they are at their limit, and "late" [s], time less the motion's. Throws
/// std::runtime_error naming file and dataset.
void read_curves(const std::filesystem::path& record, bool limited_drives, ReportInput& input);

}  // namespace dipper::analysis::report
