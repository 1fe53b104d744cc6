// Before a run: its deck, its pile, and what both sides are told.
#pragma once

#include <optional>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/run_folder.hpp"
#include "coupler/sides/sides.hpp"

namespace dipper::run {

/// When a run is done.
struct RunEnd {
  std::int64_t step = 0;  ///< DEM steps, at the latest
  /// Or as soon as the machine's channel path_time is there [s]: limited drives, which come to the
  /// motion's end when they can.
  std::optional<double> path_s;
};

/// Of end_s; where it is 0, prescribed drives end with the motion, and limited ones when they have
/// come to its end, or have not in twice its time. Throws InputError for a motion that cannot be
/// read.
RunEnd run_end(const cases::Case& c);

/// Whether a run whose record stands at that step is done. Throws std::runtime_error naming the
/// record.
bool is_done(const RunEnd& end, std::int64_t dem_step, const std::filesystem::path& record);

/// Writes deck and identity into the run's folder, settles the pile or finds it in the cache, and
/// says so. \param from  what the run goes on from; nothing: a new run. Throws what settled_pile
/// throws, launch::Interrupted too.
sides::SidesSetup prepare(const cases::Case& c, const RunFolder& folder,
                          const std::optional<Checkpoint>& from, Reporter& reporter);

}  // namespace dipper::run
