#pragma once

#include <optional>
#include <string>

namespace dipper::cli {

/// What the words of `dipper report` say.
struct ReportWords {
  std::string folder;
  std::string out;  ///< the report's folder; empty: FOLDER/report
  std::optional<double> timestep_s;
  std::string mesh, poses;  ///< of a dipper whose run is not Dipper's; both or none
};

/// Reads the run, computes its metrics and writes the report. Returns the exit status: 0, or 2 with
/// the reason on stderr and nothing written.
int report_command(const ReportWords& words);

}  // namespace dipper::cli
