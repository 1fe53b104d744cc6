// How far the teeth are from where they were sent.
#pragma once

#include <filesystem>

#include "analysis/signals/phases.hpp"
#include "coupler/case/case.hpp"

namespace dipper::run {

/// The largest distance [m] in a phase between the teeth and where taut ropes that do not stretch
/// would have them: some centimetres under load; more where the dipper rides on rock. Throws
/// std::runtime_error naming file and dataset.
double teeth_deviation(const std::filesystem::path& record, const cases::Case& c,
                       const analysis::signals::Phase& phase);

}  // namespace dipper::run
