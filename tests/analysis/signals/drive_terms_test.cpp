#include "analysis/signals/drive_terms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/signals/observe.hpp"

namespace dipper::analysis::signals {
namespace {

/// A pass of 40 s: the crowd is pushed out from 2 to 12 s at 0.4 m/s while ropes come in, the house
/// swings from 14 to 20 s, stands to 26 s, and swings back while the crowd comes in.
DriveSignals one_pass() {
  DriveSignals s;
  const auto ramp = [](double t, double from, double to) {
    return std::clamp((t - from) / (to - from), 0.0, 1.0);
  };
  for (int k = 0; k <= 40; ++k) {
    const double t = k;
    s.time_s.push_back(t);
    s.crowd_m.push_back(1 + 4 * ramp(t, 2, 12) - 4 * ramp(t, 28, 38));
    s.hoist_m.push_back(20 - 5 * ramp(t, 2, 12) + 5 * ramp(t, 28, 38));
    s.swing_rad.push_back(1.2 * ramp(t, 14, 20) - 1.2 * ramp(t, 26, 34));
    s.hoist_force_N.push_back(500e3);
    s.crowd_force_N.push_back(-100e3);
  }
  return s;
}

double value(const std::array<double, kDriveTerms.size()>& row, const std::string& name) {
  return force_kN({{name, 1.0}}, row);
}

TEST(DriveTerms, AreThoseOfAKnownPass) {
  const auto rows = drive_terms(one_pass(), {{0, 40}});
  ASSERT_EQ(rows.size(), 41U);
  EXPECT_EQ(value(rows[7], "constant_kN"), 1);
  EXPECT_EQ(value(rows[7], "crowd_out_kN"), 1);
  EXPECT_EQ(value(rows[7], "crowd_in_kN"), 0);
  EXPECT_EQ(value(rows[33], "crowd_in_kN"), 1);
  EXPECT_EQ(value(rows[7], "hoist_in_kN"), 1);
  EXPECT_EQ(value(rows[33], "hoist_out_kN"), 1);
  EXPECT_NEAR(value(rows[7], "crowd_speed_kNs_m"), 0.4, 1e-12);
  EXPECT_NEAR(value(rows[7], "hoist_speed_kNs_m"), 0.5, 1e-12);
  EXPECT_NEAR(value(rows[7], "crowd_extension_kN_m"), 2, 1e-12);
  EXPECT_NEAR(value(rows[7], "crowd_drag_kN_m"), 2, 1e-12);
  EXPECT_NEAR(value(rows[33], "crowd_drag_kN_m"), -2, 1e-12);
  EXPECT_EQ(value(rows[23], "crowd_drag_kN_m"), 0);  // at rest
  EXPECT_EQ(value(rows[7], "swing_kN"), 0);
  EXPECT_EQ(value(rows[17], "swing_kN"), 1);
  EXPECT_NEAR(value(rows[23], "swing_angle_kN_rad"), 1.2, 1e-12);
  EXPECT_EQ(value(rows[7], "load_kN"), 0);
  EXPECT_EQ(value(rows[17], "load_kN"), 1);  // on its way to the truck
  EXPECT_EQ(value(rows[23], "load_kN"), 0);
  EXPECT_EQ(value(rows[7], "pass_kN"), 1);
}

TEST(DriveTerms, PassesAreCountedFromTheirStarts) {
  DriveSignals s = one_pass();
  for (int k = 41; k <= 80; ++k) {
    const auto i = static_cast<std::size_t>(k - 40);
    s.time_s.push_back(k);
    s.crowd_m.push_back(s.crowd_m[i]);
    s.hoist_m.push_back(s.hoist_m[i]);
    s.swing_rad.push_back(s.swing_rad[i]);
  }
  const auto rows = drive_terms(s, {{0, 40}, {40, 80}});
  EXPECT_EQ(value(rows[40], "pass_kN"), 1);
  EXPECT_EQ(value(rows[41], "pass_kN"), 2);
  EXPECT_EQ(value(rows[57], "load_kN"), 1);
}

TEST(DriveTerms, ALawIsAddedToTheReadingsOfItsForce) {
  Instruments plain, lawful;
  lawful.crowd_law = {{"crowd_out_kN", 90}, {"crowd_in_kN", -90}};
  lawful.hoist_law = {{"load_kN", -30}, {"constant_kN", 5}};
  const auto before = log_signals(one_pass(), plain, {{0, 40}}),
             after = log_signals(one_pass(), lawful, {{0, 40}});
  const auto more = [&](std::size_t k) {
    return std::array<double, 2>{after[k].hoist_force_kN - before[k].hoist_force_kN,
                                 after[k].crowd_force_kN - before[k].crowd_force_kN};
  };
  EXPECT_EQ(more(6), (std::array<double, 2>{5, 90}));
  EXPECT_EQ(more(17), (std::array<double, 2>{-25, 0}));
  EXPECT_EQ(more(32), (std::array<double, 2>{5, -90}));
  EXPECT_EQ(after[6].crowd_m, before[6].crowd_m);
}

TEST(DriveTerms, AnotherNameIsNone) {
  EXPECT_TRUE(is_drive_term("swing_angle_kN_rad"));
  EXPECT_FALSE(is_drive_term("swing_angle"));
  EXPECT_THROW(value({}, "swing"), std::invalid_argument);
}

}  // namespace
}  // namespace dipper::analysis::signals
