// The signals of a record that tell its passes.
#pragma once

#include <filesystem>

#include "analysis/signals/passes.hpp"

namespace dipper::run {

/// Throws std::runtime_error naming file and dataset.
analysis::signals::PassSignals read_pass_signals(const std::filesystem::path& record);

}  // namespace dipper::run
