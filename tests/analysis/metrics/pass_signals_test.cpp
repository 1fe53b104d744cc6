#include "analysis/metrics/pass_signals.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace dipper::analysis::metrics {
namespace {

/// 20 s at 10 Hz: crowd 3 MN and hoist 4 MN from 5 s to 10 s, none before and after; hoist power
/// rises as 1 kW/s; the dipper rises with 1 m/s until 15 s and then stands; 60 t hang in it
/// until the door gives way at 17.7 s.
run::RunSignals signals() {
  run::RunSignals s;
  std::vector<Pose> X_WB;
  std::vector<Twist> V_WB_W;
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.1 * i;
    const bool dig = t > 4.95 && t < 10.05;
    s.pass.time_s.push_back(t);
    s.pass.door_rad.push_back(t > 17.75 ? 1e-3 * (t - 17.7) : 0);
    s.pass.crowd_force_N.push_back(dig ? -3e6 : 0);
    s.pass.hoist_force_N.push_back(dig ? 4e6 : 0);
    s.pass.dipper_mass_kg.push_back(6e3 * t);
    s.drive.hoist_power_W.push_back(1e3 * t);
    s.drive.crowd_power_W.push_back(-2e3);
    s.drive.swing_power_W.push_back(0);
    s.rock_work_J.push_back(-500 * t);
    s.weight_N.push_back(t < 15 ? 1e6 : (t > 17.75 ? 40e3 : 60e3) * 9.81);
    X_WB.push_back({Quaterniond::Identity(), {0, 0, std::min(t, 15.0)}});
    V_WB_W.push_back({Vector3d::Zero(), {0.5, 0, t < 15 ? 1.0 : 0.0}});
  }
  s.drive.time_s = s.pass.time_s;
  s.walls["dipper"] = rock::PoseTrack(s.pass.time_s, X_WB, V_WB_W);
  return s;
}

TEST(Effort, IsTheIntegralOverAPhase) {
  const Effort e = effort(signals(), 6, 10);
  EXPECT_NEAR(e.dig_force_mean_N, 5e6, 1e-3);
  EXPECT_NEAR(e.dig_force_peak_N, 5e6, 1e-3);
  EXPECT_NEAR(e.drives.hoist.work_J, 1e3 * (100 - 36) / 2, 1e-6);
  EXPECT_NEAR(e.drives.crowd.work_J, -2e3 * 4, 1e-6);
  EXPECT_NEAR(e.rock_work_J, -500 * 4, 1e-6);
  EXPECT_NEAR(e.mass_gain_kg, 24e3, 1e-6);
  EXPECT_NEAR(effort(signals(), 0, 20).dig_force_mean_N, 5e6 * 5.1 / 20, 1e-3);
}

TEST(Effort, OfAPhaseBetweenTwoRowsOrOfOneRowIsNotZero) {
  const Effort between = effort(signals(), 6.01, 6.05);
  EXPECT_NEAR(between.dig_force_mean_N, 5e6, 1e-3);
  EXPECT_NEAR(between.dig_force_peak_N, 5e6, 1e-3);
  EXPECT_NEAR(between.rock_work_J, -500 * 0.04, 1e-9);
  EXPECT_NEAR(between.mass_gain_kg, 6e3 * 0.04, 1e-9);
  EXPECT_NEAR(between.drives.hoist.power_mean_W, 6.05e3, 1e-6);
  EXPECT_NEAR(between.drives.hoist.work_J, 6.05e3 * 0.04, 1e-6);
  run::RunSignals s = signals();  // a run that ends 0.03 s after a phase has begun, at 6.07 s
  for (auto* v : {&s.pass.time_s, &s.pass.crowd_force_N, &s.pass.hoist_force_N,
                  &s.pass.dipper_mass_kg, &s.drive.time_s, &s.drive.hoist_power_W,
                  &s.drive.crowd_power_W, &s.drive.swing_power_W, &s.rock_work_J})
    v->resize(62);
  const Effort last = effort(s, 6.07, 6.1);
  EXPECT_NEAR(last.dig_force_mean_N, 5e6, 1e-3);
  EXPECT_NEAR(last.rock_work_J, -500 * 0.03, 1e-9);
  EXPECT_NEAR(last.drives.crowd.power_mean_W, -2e3, 1e-6);
}

TEST(StaticWeight, TakesTheSecondBeforeTheDoorOpens) {
  signals::Pass pass;
  pass.t_dump_s = 18;
  const auto w = static_weight(signals(), pass);
  ASSERT_TRUE(w);
  EXPECT_NEAR(w->mass_kg, 60e3, 1e-6);
  EXPECT_NEAR(w->from_s, 17, 1e-9);
  EXPECT_NEAR(w->to_s, 17.7, 1e-9);  // then the door gives way
}

TEST(StaticWeight, ARisingDipperIsNotWeighed) {
  signals::Pass pass;
  pass.t_dump_s = 14;
  EXPECT_FALSE(static_weight(signals(), pass));
}

TEST(PoseTrack, GoesBetweenItsPoses) {
  const rock::PoseTrack track(
      {0, 2}, {{Quaterniond::Identity(), {0, 0, 0}}, {from_rotation_vector({0, 0, 1}), {4, 0, 0}}});
  const BodyState s = track.at(0.5);
  EXPECT_NEAR(s.X_WB.p.x(), 1, 1e-12);
  EXPECT_NEAR(rotation_vector(s.X_WB.R).z(), 0.25, 1e-12);
  EXPECT_NEAR(s.V_WB_W.w.z(), 0.5, 1e-12);
  EXPECT_NEAR(rock::velocity_at(s, {1, 2, 0}).x(), 2 - 0.5 * 2, 1e-12);
  EXPECT_NEAR(track.at(9).X_WB.p.x(), 4, 1e-12);
  EXPECT_NEAR(track.at(9).V_WB_W.v.norm(), 0, 1e-12);
}

}  // namespace
}  // namespace dipper::analysis::metrics
