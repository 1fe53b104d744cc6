// A run's replay, small enough for a page.
//
// The rule by which it is made small, in this order:
//   1. more than `spheres_max` spheres: one rock in k is shown, k the smallest that fits;
//   2. more than `bytes_max` after compression: every 2nd frame is shown, or every 4th, 8th ...;
//      the last frame always.
#pragma once

#include <nlohmann/json.hpp>

#include "analysis/report/replay_encoder.hpp"

namespace dipper::analysis::report {

struct ReplayLimits {
  std::size_t spheres_max = 40000;
  std::size_t bytes_max = 15'000'000;     ///< 20 MB as base64, of a page's 25
  std::size_t decoded_max = 200'000'000;  ///< held by the browser while it plays
  std::size_t block_bytes = 4'000'000;    ///< before compression; each is shown as it is read
};

struct ReplayBlocks {
  nlohmann::json head;  ///< sizes, times, box, radii, classes, walls and their poses
  std::vector<std::vector<std::uint8_t>> blocks;  ///< gzip, whole frames each
};

ReplayBlocks encode_replay(const ReplaySource& source, const ReplayLimits& limits = {});

}  // namespace dipper::analysis::report
