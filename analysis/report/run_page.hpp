// The report's page of a run's folder, or of dumps alone.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "analysis/io/dump_folder.hpp"
#include "analysis/run/figure.hpp"
#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::report {

/// `metrics` as docs/metrics.md says. Throws what the record's and the dumps' readers throw, and
/// std::runtime_error when the file cannot be written.
void write_run_page(const run::RunData& run, const io::DumpFolder& dumps,
                    const nlohmann::ordered_json& metrics, const run::Figure& figure,
                    const std::filesystem::path& file);

}  // namespace dipper::analysis::report
