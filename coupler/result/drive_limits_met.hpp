// How often limited drives were at their limits, and how late that made the machine.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"

namespace dipper::result {

/// Adds these figures of the whole run to the summary of a case with limited drives, as "drives"
/// (docs/drives.md), and reports them. Throws std::runtime_error naming file and dataset.
void report_drives(const cases::Case& c, const std::filesystem::path& record,
                   nlohmann::ordered_json& summary, Reporter& reporter);

}  // namespace dipper::result
