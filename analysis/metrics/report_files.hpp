// The report's folder: metrics.json and a CSV a table, all or nothing.
#pragma once

#include <functional>

#include "analysis/metrics/metrics.hpp"

namespace dipper::analysis::metrics {

/// A table of metrics.json as CSV: an array of rows, or an object of columns. Nested values of a
/// row are left out, except lists of numbers, which become NAME_1, NAME_2, ...
std::string to_csv(const nlohmann::ordered_json& table);

/// Fills `folder` through a new folder beside it, which is moved into place when everything is
/// written; the old contents are replaced only then. `more` may add files to the
/// folder it is given. Throws std::runtime_error when a file cannot be written.
void write_report(const Metrics& metrics, const std::filesystem::path& folder,
                  const std::function<void(const std::filesystem::path&)>& more = {});

}  // namespace dipper::analysis::metrics
