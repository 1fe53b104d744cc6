// Before a run: its deck, its pile, and what both sides are told.
#pragma once

#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/run_folder.hpp"
#include "coupler/sides/sides.hpp"

namespace dipper::run {

/// DEM steps of the whole run. Throws InputError for a motion that cannot be read.
std::int64_t end_step(const cases::Case& c);

/// Writes deck and identity into the run's folder, settles the pile or finds it in the cache, and
/// says so. \param from  what the run goes on from; nothing: a new run. Throws what settled_pile
/// throws, launch::Interrupted too.
sides::SidesSetup prepare(const cases::Case& c, const RunFolder& folder,
                          const std::optional<Checkpoint>& from, Reporter& reporter);

}  // namespace dipper::run
