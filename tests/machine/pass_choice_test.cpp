#include "machine/pass_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/angles.hpp"
#include "common/gravity.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion_row.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

MotionPlan cycle() {
  MotionPlan p;
  p.sample_s = 0.25;
  p.cycle_s = 48;
  p.dig = {0.5, 18, 1.5};
  p.swing_out = {13.5, 22, 2.5};
  p.door_open = {22, 23.5, 0.6};
  p.swing_back = {27, 36.5, 2.5};
  p.back = {29.5, 43.5, 3};
  p.door_close = {34.5, 37.5, 1};
  p.lift = {{24.2, 11.4}, {22.6, 14.3}, {21.3, 15.2}};
  for (const auto& [deg, m] :
       {std::pair{8.0, 12.1}, {-12.0, 11.5}, {-30.0, 11.15}, {-48.0, 11.1}, {-60.0, 11.1}})
    p.lower.emplace_back(9.2 + m * std::cos(radians(deg)), 10.8 + m * std::sin(radians(deg)));
  p.dump_rad = radians(80);
  p.door_rad = radians(75);
  return p;
}

class PassChoice : public testing::Test {
 protected:
  PassChoice() {
    choice.heading_rad = {0};
    choice.depth_m = {0.8};
    choice.floor_rise = {0.1};
    choice.exit_z_m = {7};
    choice.start = {13.1, 0.4};
    choice.smooth_m = 3;
    choice.crowd_max_m = 2.95;
    choice.teeth_m_s = 1.2;
    facts.bulk_density_kg_m3 = 1900;
    facts.capacity_kg = 80e3;
    facts.specific_resistance_Pa = 0.38e6;
    facts.half_width_m = 6;
    facts.walls_from_x_m = 13.5;
  }

  DigPlanner planner(DigGoal goal = DigGoal::time) const {
    return {choice, cycle(), facts, data, Vector3d::Zero(), radians(61.8), goal};
  }

  /// A bench of 8.5 m whose face stands at 35 degrees; `low_from_y`: half as high from there on.
  HeightMap bench(double low_from_y = 100) const {
    HeightMap map(planner().grid());
    for (int i = 0; i < map.grid().nx; ++i)
      for (int j = 0; j < map.grid().ny; ++j) {
        const double z = std::clamp((map.x_of(i) - 13.5) * std::tan(radians(35)), 0.0, 8.5);
        map.at(i, j) = map.y_of(j) > low_from_y ? z / 2 : z;
      }
    return map;
  }

  DigDecision decide(const HeightMap& face, double least_kg = 0, double most_kg = kNoEnd) const {
    return planner().decide(face, planner().start(), least_kg, most_kg);
  }

  MachineData data = load_machine(test::source() / "mbs" / "bucyrus495.yaml");
  DigChoice choice;
  DigFacts facts;
};

TEST_F(PassChoice, ADigTakesItsDepthOutOfTheFaceAndMeetsItsResistance) {
  const DigDecision d = decide(bench());
  ASSERT_EQ(d.chosen, 0) << d.reason;
  const DigCandidate& c = d.candidates[0];
  // About the way up the face by depth by the dipper's width.
  const double way_m = 7 / std::sin(radians(35));
  EXPECT_NEAR(c.swept_m3, way_m * 0.8 * data.dipper.inside.y(), 0.3 * c.swept_m3);
  const double loaded_kg = DigExperience().loaded * 1900 * c.swept_m3;
  ASSERT_LT(loaded_kg, 0.75 * 80e3) << "else the dipper may overflow";
  EXPECT_NEAR(c.payload_kg, loaded_kg, 1e-3 * loaded_kg);
  const double cut_N = 0.38e6 * 0.8 * data.dipper.inside.y();
  EXPECT_GT(c.crowd_peak_N, 0.4 * cut_N);
  EXPECT_LT(c.crowd_peak_N, 3 * cut_N);
}

TEST_F(PassChoice, WithoutRockTheRopesCarryTheDipperByVirtualWork) {
  // The last of the way is in the air: hoist and crowd hold weights alone, whose moment about the
  // saddle the rope carries. Energy of the way is at least what weights were raised by.
  facts.specific_resistance_Pa = 0;
  facts.bulk_density_kg_m3 = 1e-3;
  const DigCandidate c = decide(bench()).candidates[0];
  const ShovelKinematics shovel(data, Pose{}, radians(61.8));
  const auto potential = [&](const Vector2d& tip) {
    const ShovelPose X = shovel.pose(shovel.teeth_at(tip));
    const Vector3d end = X.X_WB * data.dipper.handle_end;
    const Vector3d handle =
        end + data.handle.mass_center * (end - data.saddle.position).normalized();
    return kGravity_m_s2 *
           (data.dipper.mass * (X.X_WB * data.dipper.mass_center).z() +
            data.door.mass * (X.X_WD * data.door.mass_center).z() + data.handle.mass * handle.z());
  };
  const double raised = potential(cycle().lift.back()) - potential(choice.start);
  EXPECT_GE(c.energy_J, raised);
  EXPECT_LT(c.energy_J, 1.6 * raised) << "the crowd brakes for part of the way";
}

TEST_F(PassChoice, RefusesWhatTheDrivesCannotDo) {
  choice.depth_m = {0.8, 2.5};
  data.drives.crowd.stall = 2.0e6;
  const DigDecision d = decide(bench());
  ASSERT_EQ(d.chosen, 0) << d.reason;
  EXPECT_NE(d.candidates[1].refused.find("the crowd needs"), std::string::npos);
  EXPECT_NE(d.reason.find("; 1 refused, as heading 0 deg, depth 2.50 m: the crowd needs"),
            std::string::npos)
      << d.reason;
  data.drives.crowd.stall = 1e5;
  const DigDecision none = decide(bench());
  EXPECT_EQ(none.chosen, -1);
  EXPECT_NE(none.reason.find("no dig pays"), std::string::npos) << none.reason;
  EXPECT_TRUE(none.rows.empty());
}

TEST_F(PassChoice, ExpectsLessLoadBeyondTheDrivesLimits) {
  const DigCandidate strong = decide(bench()).candidates[0];
  data.drives.crowd.stall = strong.crowd_peak_N / 1.4;
  const DigDecision eased = decide(bench());
  ASSERT_EQ(eased.chosen, 0) << eased.reason;
  EXPECT_NE(eased.reason.find("a drive is at its limit"), std::string::npos) << eased.reason;
  EXPECT_NEAR(eased.candidates[0].payload_kg, strong.payload_kg / 1.4, 1e-3 * strong.payload_kg);
  EXPECT_EQ(decide(bench(), strong.payload_kg).chosen, -1);
  data.drives.crowd.stall = strong.crowd_peak_N / 2.1;
  const DigDecision none = decide(bench());
  EXPECT_EQ(none.chosen, -1);
  EXPECT_NE(none.candidates[0].refused.find("the crowd needs"), std::string::npos);
  EXPECT_NE(none.reason.find("0 of 1 digs are feasible"), std::string::npos) << none.reason;
}

// The mean of the smaller of the capacity and a normal load of 15 % deviation, by summation.
TEST_F(PassChoice, MoreThanTheDipperHoldsMakesAFullDipperSurer) {
  const auto summed = [](double mean, double capacity) {
    double sum = 0, weights = 0;
    for (int i = -6000; i <= 6000; ++i) {
      const double z = 1e-3 * i, weight = std::exp(-0.5 * z * z);
      sum += weight * std::min(capacity, mean * (1 + 0.15 * z));
      weights += weight;
    }
    return sum / weights;
  };
  const double loaded_kg = DigExperience().loaded * 1900 * decide(bench()).candidates[0].swept_m3;
  for (const double by : {0.8, 1.0, 1.3}) {
    facts.capacity_kg = loaded_kg / by;
    data.drives.crowd.stall = data.drives.hoist.stall = 1e8;
    const double payload_kg = decide(bench()).candidates[0].payload_kg;
    EXPECT_NEAR(payload_kg, summed(loaded_kg, 1.05 * facts.capacity_kg), 1e-4 * loaded_kg) << by;
    EXPECT_LT(payload_kg, 1.05 * facts.capacity_kg);
  }
}

TEST_F(PassChoice, ALoadThatScattersFillsTheLastOfATruckMoreSurelyIfItIsExpectedToBeMore) {
  choice.depth_m = {0.8, 1.2};
  data.drives.crowd.stall = data.drives.hoist.stall = 1e8;
  const DigDecision all = decide(bench());
  const double room_kg = all.candidates[0].loose_kg;
  ASSERT_LT(room_kg, 0.8 * all.candidates[1].loose_kg);
  const DigDecision d = decide(bench(), 0, room_kg);
  for (const DigCandidate& c : d.candidates) EXPECT_LT(c.score * c.cycle_s, room_kg);
  const auto counts_kg = [&](int k) {
    const DigCandidate& c = d.candidates[static_cast<std::size_t>(k)];
    return c.score * c.cycle_s;
  };
  EXPECT_GT(counts_kg(1), 1.05 * counts_kg(0));
}

TEST_F(PassChoice, TurnsToWhereTheRockIs) {
  choice.heading_rad = {radians(-8), 0, radians(8)};
  const DigDecision d = decide(bench(-2));  // low to the left and in the middle
  ASSERT_GE(d.chosen, 0) << d.reason;
  EXPECT_NEAR(degrees(d.candidates[static_cast<std::size_t>(d.chosen)].heading_rad), -8, 1e-9);
  choice.heading_rad = {radians(-25)};
  EXPECT_NE(decide(bench()).candidates[0].refused.find("side of the bench"), std::string::npos);
}

TEST_F(PassChoice, LeavesDigsThatDoNotPayAndThatTheTruckCannotTake) {
  EXPECT_EQ(decide(bench(), 100e3).chosen, -1);
  choice.depth_m = {0.3, 0.9};
  const DigDecision all = decide(bench()), rest = decide(bench(), 0, 5e3);
  ASSERT_GE(all.chosen, 0);
  EXPECT_EQ(all.chosen, 1) << "more payload for time";
  EXPECT_EQ(rest.chosen, 0) << "5 t are as soon dug with little";
}

TEST_F(PassChoice, UsesResistanceAndLoadOfThePassesBefore) {
  const DigPlanner p = planner();
  const auto with = [&](const DigExperience& before) {
    return p.decide(bench(), p.start(), 0, kNoEnd, before).candidates[0];
  };
  const double loaded = DigExperience().loaded;
  const DigCandidate plain = with({}), hard = with({1.5, loaded}), poor = with({1, 0.6});
  // Crowd is linear in the rock's resistance: what half as much more adds, as much more adds twice.
  const DigCandidate harder = with({2, loaded});
  EXPECT_NEAR(harder.crowd_mean_N - plain.crowd_mean_N,
              2 * (hard.crowd_mean_N - plain.crowd_mean_N), 1e-6 * plain.crowd_mean_N);
  EXPECT_GT(hard.crowd_mean_N, 1.2 * plain.crowd_mean_N);
  EXPECT_DOUBLE_EQ(poor.swept_m3, plain.swept_m3);
  EXPECT_NEAR(poor.payload_kg, 0.6 * 1900 * poor.swept_m3, 1);
  EXPECT_LT(plain.rock_from_m, plain.rock_to_m);
}

TEST_F(PassChoice, ComesDownAsFarAsTheRockAtTheToeLets) {
  HeightMap heap = bench();
  const DigDecision free = decide(heap);
  EXPECT_LT((free.candidates[0].dig.front() - choice.start).norm(), 1e-6);
  for (int i = 0; i < heap.grid().nx; ++i)
    for (int j = 0; j < heap.grid().ny; ++j)
      if (heap.x_of(i) > 12 && heap.x_of(i) < 15) heap.at(i, j) = std::max(heap.at(i, j), 1.0);
  const DigCandidate over = decide(heap).candidates[0];
  ASSERT_TRUE(over.refused.empty()) << over.refused;
  EXPECT_GT(over.dig.front().y(), 1.1);
  EXPECT_LT(over.dig.front().y(), 2.8);
}

TEST_F(PassChoice, TheRowsAreAMotionTheMachineCanFollow) {
  const DigDecision first = decide(bench());
  ASSERT_EQ(first.chosen, 0) << first.reason;
  const ShovelKinematics shovel(data, Pose{}, radians(61.8));
  Motion motion = Motion::parse(kMotionHead + first.rows, "first");
  const Drives at_start = motion.value(0), at_end = motion.value(motion.end_ns());
  EXPECT_LT((shovel.teeth(at_start) - choice.start).norm(), 2e-3);
  EXPECT_NEAR(at_end.swing, radians(80), 1e-6);
  EXPECT_NEAR(at_end.door, radians(75), 1e-6);
  // The next one begins where this ended, and goes on from it without a jump.
  PassStart from;
  from.t_s = first.times.end_s + 1;
  from.at_dump = true;
  const DigDecision next = planner().decide(bench(), from, 0, kNoEnd);
  ASSERT_EQ(next.chosen, 0) << next.candidates[0].refused;
  motion.extend(Motion::parse(kMotionHead + next.rows, "next"));
  EXPECT_TRUE(shovel.check(motion).empty()) << shovel.check(motion).front();
  const Drives back = motion.at(next.times.dig_s).position;
  EXPECT_LT((shovel.teeth(back) - choice.start).norm(), 2e-2);
  EXPECT_NEAR(back.door, 0, 1e-6);
  EXPECT_NEAR(back.swing, 0, 1e-3);
}

}  // namespace
}  // namespace dipper::machine
