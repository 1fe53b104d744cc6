// The run's report: one self-contained HTML file.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/report/replay_blocks.hpp"
#include "analysis/report/replay_source.hpp"
#include "analysis/run/figure.hpp"

namespace dipper::analysis::report {

/// One signal for the page, as recorded; the writer reduces its points.
struct ReportCurve {
  std::string name;  ///< a channel of record.h5, such as "machine/hoist_force"
  std::string unit;
  std::vector<double> values;
};

/// The page's data. Every part may be missing: its section is then left out.
struct ReportInput {
  nlohmann::json metrics;      ///< as docs/metrics.md says
  std::vector<double> time_s;  ///< of every curve
  std::vector<ReportCurve> curves;
  std::string case_text;     ///< key=value lines
  nlohmann::json decisions;  ///< of an operator who plans: {decisions: [...], end}; null: none
  const ReplaySource* replay = nullptr;
  run::Figure figure;  ///< drawn in the replay
};

/// Times and curves thinned out, as pages read them: {time_s, channels: {NAME: {unit, values}}}.
/// Throws std::invalid_argument for a curve without one value per time.
nlohmann::json curves_json(const ReportInput& input);

/// The page's text. `title` goes into the browser's tab.
std::string report_page(const std::string& title, const ReportInput& input,
                        const ReplayLimits& limits = {});

/// Throws std::runtime_error naming the file when it cannot be written.
void write_report_page(const std::string& title, const ReportInput& input,
                       const std::filesystem::path& file);

}  // namespace dipper::analysis::report
