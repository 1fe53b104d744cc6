// A run's settings besides its case.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// The settings (--set, --seed, --ranks) in settings.txt of a run's folder, one line KEY=VALUE
/// each; none if there is no such file. A resumed run reads them there.
std::vector<cases::Override> read_settings(const std::filesystem::path& run);

/// Writes them; of a repeated key only the last. Throws std::runtime_error naming the file.
void write_settings(const std::filesystem::path& run, const std::vector<cases::Override>& settings);

}  // namespace dipper::run
