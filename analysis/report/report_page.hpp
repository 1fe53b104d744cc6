// The run's report: one HTML file that needs nothing else.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/report/replay_source.hpp"

namespace dipper {

/// One signal for the page, as it was recorded; the writer thins it out.
struct ReportCurve {
  std::string name;  ///< a channel of record.h5, such as "machine/hoist_force"
  std::string unit;
  std::vector<double> values;
};

/// What the page shows. Every part may be missing: its section is then left out.
struct ReportInput {
  nlohmann::json metrics;               ///< as docs/metrics.md says
  std::vector<double> time_s;           ///< of every curve
  std::vector<ReportCurve> curves;
  std::string case_text;                ///< key=value lines
  const ReplaySource* replay = nullptr;
};

/// Curves the page draws, read from a run's record.h5; fills time_s, curves and case_text.
/// Throws std::runtime_error naming file and dataset.
void read_record(const std::filesystem::path& record, ReportInput& input);

/// Writes `file` under another name and moves it into place, so no half page is left. Throws
/// std::runtime_error naming the file.
void write_report_page(const ReportInput& input, const std::filesystem::path& file);

}  // namespace dipper
