// The page's script and style, bundled at build time from analysis/report/web.
#pragma once

#include <string_view>

namespace dipper::analysis::report {

extern const std::string_view kReportScript;
extern const std::string_view kReportStyle;

}  // namespace dipper::analysis::report
