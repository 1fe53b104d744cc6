#pragma once

#include <filesystem>
#include <string>

namespace dipper::run {

/// How a side's answers compare with the recorded ones.
struct ReplayResult {
  int segments = 0;            ///< each from the start or a checkpoint to an end
  long requests = 0;           ///< windows and commands sent again
  long windows = 0;            ///< how many of these are windows
  long different = 0;          ///< answers that are not bit-identical to the recorded ones
  double force_N = 0;          ///< largest difference in a mean force component (rock side)
  double position_m = 0;       ///< largest difference in a body's position
  double wall_s = 0;           ///< of the replay, from the first to the last answer
  double recorded_wall_s = 0;  ///< of the run, for the same requests
};

/// Runs one side ("dem" or "mbs") of the run in `run` against the recording of the other: starts
/// its process as each segment of the run did and sends it all requests of events.lcmlog, then of
/// each events-N.lcmlog, in the order of their numbers. Its output goes to a scratch folder. Throws
/// InputError for a folder without a recording, PeerError when the side fails.
ReplayResult replay(const std::filesystem::path& run, const std::string& side);

}  // namespace dipper::run
