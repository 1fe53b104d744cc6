// `dipper report`.
#pragma once

#include <optional>
#include <string>

#include "analysis/report/film.hpp"
#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

struct ReportOptions {
  std::string folder;
  std::string out;  ///< the report's folder; empty: FOLDER/report
  std::optional<double> timestep_s;
  analysis::report::FilmOptions film;
  std::string mesh, poses;  ///< of a dipper whose run is not Dipper's; both or none
};

/// Reads the run, computes its metrics and writes the report. Returns the exit status: 0, or 2
/// after reporting the reason, with nothing written.
int report_command(const ReportOptions& options, Reporter& reporter);

Command add_report_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
