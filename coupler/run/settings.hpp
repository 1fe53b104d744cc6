// What a run was asked for besides its case.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// The settings (--set, --seed, --ranks) that a run's folder keeps in settings.txt, a line
/// KEY=VALUE each; none where there is no such file. A run that goes on takes them from there.
std::vector<cases::Override> read_settings(const std::filesystem::path& run);

/// Keeps them; of a key that is there more than once the last. Throws std::runtime_error naming the
/// file.
void write_settings(const std::filesystem::path& run, const std::vector<cases::Override>& settings);

}  // namespace dipper::run
