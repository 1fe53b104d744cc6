// Checks of options that are numbers. CLI11's own take nan for a number in any range.
#pragma once

#include <CLI/CLI.hpp>

#include "common/range.hpp"

namespace dipper::cli {

/// Refuses all but numbers in the range (also nan, inf and text); the message gives the range.
CLI::Validator number_in(const Range& range);

/// The same for whole numbers.
CLI::Validator whole_number_in(const Range& range);

/// Of --seed, as of the key `seed`.
inline constexpr Range kSeeds{0, 2147483647};

}  // namespace dipper::cli
