#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::run {

/// What `dipper run` was asked for.
struct RunOptions {
  std::filesystem::path out;  ///< the run's folder
  bool resume = false;        ///< continue the run in `out` from its last checkpoint
};

/// How a run ended; the value is the program's exit status (design: Commands).
enum class Outcome { complete = 0, failed = 3, interrupted = 4 };

/// What in `c` is not as in the run that `folder` holds, one line a key: a resumed run may end
/// later, write more often and wait longer, but must be the same run otherwise.
std::vector<std::string> changed_since(const std::filesystem::path& folder, const cases::Case& c);

/// Runs a checked case: settles or finds the pile, starts both sides, steps them to the end, writes
/// the run folder. Failures of a side end here, with a message on stderr.
Outcome paired_run(const cases::Case& c, const RunOptions& options);

}  // namespace dipper::run
