#include "analysis/report/replay_blocks.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/analysis/report/synthetic_dig.hpp"

namespace dipper::analysis::report {
namespace {

std::size_t total(const ReplayBlocks& replay) {
  std::size_t bytes = 0;
  for (const auto& b : replay.blocks) bytes += b.size();
  return bytes;
}

TEST(ReplayBlocks, EveryFrameWhenThereIsRoom) {
  const test::SyntheticDig dig(500, 21, 10);
  ReplayLimits limits;
  limits.block_bytes = 5 * 7 * 500;
  const auto replay = encode_replay(dig, limits);
  EXPECT_EQ(replay.head["times_s"].size(), 21u);
  EXPECT_EQ(replay.head["one_frame_in"], 1);
  EXPECT_EQ(replay.head["frames_in_block"], (nlohmann::json{5, 5, 5, 5, 1}));
  EXPECT_EQ(replay.blocks.size(), 5u);
  ASSERT_EQ(replay.head["walls"].size(), 2u);
  EXPECT_EQ(replay.head["walls"][0]["poses"].size(), 21u);
  EXPECT_EQ(replay.head["walls"][0]["triangles_m"].size(), 12u * 9);
  EXPECT_EQ(replay.head["walls"][0]["poses"][20],
            (nlohmann::json{20.0, 0.0, 10.0, 1.0, 0.0, 0.0, 0.0}));
}

TEST(ReplayBlocks, FewerFramesUntilItFitsAndTheLastOneStays) {
  const test::SyntheticDig dig(500, 22, 10);
  const std::size_t whole = total(encode_replay(dig));
  ReplayLimits limits;
  limits.block_bytes = 7 * 500;
  limits.bytes_max = whole / 3;
  const auto replay = encode_replay(dig, limits);
  EXPECT_LE(total(replay), limits.bytes_max);
  EXPECT_GE(replay.head["one_frame_in"], 2);
  EXPECT_EQ(replay.head["frames_in_run"], 22);
  EXPECT_EQ(replay.head["times_s"].front(), 0.0);
  EXPECT_EQ(replay.head["times_s"].back(), 10.0);
}

TEST(ReplayBlocks, FewerRocksWhenThereAreTooMany) {
  const test::SyntheticDig dig(3000, 3, 1);
  ReplayLimits limits;
  limits.spheres_max = 1200;
  const auto replay = encode_replay(dig, limits);
  EXPECT_LE(replay.head["spheres"], 1200);
  EXPECT_GT(replay.head["spheres"], 600);
  EXPECT_EQ(replay.head["spheres_in_run"], 3000);
  EXPECT_EQ(replay.head["radius_m"].size(), replay.head["spheres"].get<std::size_t>());
}

TEST(ReplayBlocks, ARunWithoutSpheres) {
  const test::SyntheticDig dig(0, 4, 1);
  const auto replay = encode_replay(dig);
  EXPECT_EQ(replay.head["spheres"], 0);
  EXPECT_EQ(replay.head["times_s"].size(), 4u);
}

}  // namespace
}  // namespace dipper::analysis::report
