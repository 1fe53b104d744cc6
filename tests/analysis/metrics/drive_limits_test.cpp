// What limited drives did at their limits: a record of five rows, of half a second each.
#include "analysis/metrics/drive_limits.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "common/record/record.hpp"
#include "common/temporary_folder.hpp"

namespace dipper::analysis::metrics {
namespace {

TEST(DriveLimits, AddUpOverThePartsOfARun) {
  const TemporaryFolder folder("dipper-drive-limits");
  const auto file = folder.path() / "record.h5";
  {
    record::Record r = record::Record::create(file, {});
    std::vector<std::size_t> channels;
    for (const char* name :
         {"time_s", "machine/path_time", "machine/hoist_saturated", "machine/crowd_saturated",
          "machine/swing_saturated", "machine/ropes_slack", "machine/crowd_relief"})
      channels.push_back(r.add(name, "", ""));
    const std::vector<std::vector<double>> rows = {{0, 0, 0, 0, 0, 0, 0},
                                                   {0.5, 0.5, 0, 1, 0, 0, 0},
                                                   {1.0, 0.7, 0, 1, 0, 1, 0.2},
                                                   {1.5, 0.9, 1, 0, 0, 0, 0.3},
                                                   {2.0, 1.4, 0, 0, 0, 0, 0.1}};
    for (const auto& row : rows) {
      for (std::size_t k = 0; k < row.size(); ++k) r.put(channels[k], row[k]);
      r.next();
    }
    r.flush();
  }
  const DriveLimits limits(file);
  const LimitsMet all = limits.over_all();
  EXPECT_DOUBLE_EQ(all.hoist_saturated_s, 0.5);
  EXPECT_DOUBLE_EQ(all.crowd_saturated_s, 1.0);
  EXPECT_DOUBLE_EQ(all.swing_saturated_s, 0);
  EXPECT_DOUBLE_EQ(all.ropes_slack_s, 0.5);
  EXPECT_NEAR(all.late_s, 0.6, 1e-12);
  EXPECT_DOUBLE_EQ(all.crowd_relief_most_m, 0.3);
  const LimitsMet before = limits.over({0, 1}), after = limits.over({1, 2});
  EXPECT_DOUBLE_EQ(before.crowd_relief_most_m, 0.2);
  EXPECT_DOUBLE_EQ(before.crowd_saturated_s + after.crowd_saturated_s, all.crowd_saturated_s);
  EXPECT_NEAR(before.late_s + after.late_s, all.late_s, 1e-12);
  EXPECT_DOUBLE_EQ(limits.over({5, 6}).late_s, 0);
}

}  // namespace
}  // namespace dipper::analysis::metrics
