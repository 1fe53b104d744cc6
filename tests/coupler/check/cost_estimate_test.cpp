#include "coupler/check/cost_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/memory_reporter.hpp"
#include "tests/coupler/case/checkout.hpp"
#include "tests/places.hpp"

namespace dipper::check {
namespace {

cases::Case load(const std::filesystem::path& folder, const std::vector<cases::Override>& set) {
  std::vector<Finding> findings;
  cases::Case c = cases::load_case(folder, set, findings);
  test::expect_findings(findings, {});
  return c;
}

/// Within the factor that it claims, here 1.5, and no better than it can know.
testing::Matcher<double> about(double measured) {
  return testing::AllOf(testing::Gt(measured / 1.5), testing::Lt(measured * 1.5));
}

// The measured figures are those of docs/benchmarks.md, "What a run takes".
TEST(CostEstimate, IsWhatRunsHaveTaken) {
  const test::Checkout checkout(true);
  const CostEstimate narrow = cost_estimate(load(checkout.folder(), {}));
  EXPECT_THAT(narrow.spheres, about(5701));
  EXPECT_THAT(narrow.dig_s, about(106 + 7));

  const std::filesystem::path source = test::source();
  const CostEstimate quick =
      cost_estimate(load(source / "cases" / "quick", {{"machine.drives", "prescribed"}}));
  EXPECT_THAT(quick.spheres, about(12607));
  EXPECT_THAT(quick.dig_s, about(72));
  EXPECT_THAT(quick.record_B, about(21e6));
  EXPECT_THAT(quick.disk_B - quick.dumps_B, about(238e6 - 107e6));
  const CostEstimate frames = cost_estimate(
      load(source / "cases" / "quick", {{"end_s", "1.65"}, {"output.dump_every_s", "0.0165"}}));
  EXPECT_THAT(frames.dumps_B, about(33e6));
  EXPECT_THAT(frames.disk_B, about(48e6));

  EXPECT_THAT(cost_estimate(load(source / "cases" / "screening", {})).dig_s, about(86));
  EXPECT_THAT(cost_estimate(load(source / "cases" / "aitik_coarse", {})).dig_s, about(316));

  const CostEstimate aitik = cost_estimate(load(source / "cases" / "aitik", {}));
  EXPECT_THAT(aitik.spheres, about(207964));
  EXPECT_THAT(aitik.dig_s, about(5005 + 46));
  EXPECT_THAT(aitik.memory_B, about(0.68e9));
}

TEST(CostEstimate, AWindowCostsWhateverTheRockDoes) {
  const std::filesystem::path quick = test::source() / "cases" / "quick";
  const double all = cost_estimate(load(quick, {{"coupling.sync_steps", "5"}})).dig_s,
               half = cost_estimate(load(quick, {{"coupling.sync_steps", "10"}})).dig_s;
  EXPECT_THAT(all - half, about((4.4 + 6.7) / 2));
}

TEST(CostEstimate, SaysHowLongOnRanks) {
  const test::Checkout checkout(true);
  const CostEstimate one = cost_estimate(load(checkout.folder(), {{"dem.ranks", "1"}})),
                     two = cost_estimate(load(checkout.folder(), {{"dem.ranks", "2"}}));
  EXPECT_DOUBLE_EQ(one.wall_s, one.settle_s + one.dig_s);
  EXPECT_DOUBLE_EQ(two.wall_s, one.wall_s / 2);
  EXPECT_THAT(
      to_string({1e5, 600, 7200, 7800, 3e8, 2.5e9}),
      testing::HasSubstr("estimate: 2 h 10 min of processor time (2 h 0 min to dig, 10 min to "
                         "settle the pile unless it is in the cache), 2 h 10 min of wall "
                         "time if each rank has a core, 300 MB of memory, 2.5 GB of disk"));
}

TEST(CostEstimate, ComesWithAWarningWhereTheDiskIsTooSmall) {
  const test::Checkout checkout(true);
  test::MemoryReporter fits, full;
  report_full_disk(load(checkout.folder(), {{"output.dump_every_s", "0"}}), "no/such/folder", fits);
  EXPECT_EQ(fits.lines, "");
  const cases::Case huge =
      load(checkout.folder(), {{"output.dump_every_s", "0.001"}, {"end_s", "100000"}});
  report_full_disk(huge, "no/such/folder", full);
  EXPECT_THAT(full.lines, testing::MatchesRegex(
                              "warning: output.dump_every_s: /.* has .* free, but the run "
                              "needs about .*; with 0, dumps at the start only, it needs .*\n"));
  EXPECT_LT(cost_estimate(load(checkout.folder(), {{"output.dump_every_s", "0"}})).disk_B,
            0.6 * cost_estimate(load(checkout.folder(), {{"output.dump_every_s", "0.02"}})).disk_B);
}

}  // namespace
}  // namespace dipper::check
