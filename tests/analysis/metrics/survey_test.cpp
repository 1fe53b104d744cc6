// Frames by hand: a dipper that moves, rocks with known fates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/metrics/frame_survey.hpp"
#include "analysis/metrics/pile_surface.hpp"
#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::metrics {
namespace {

using testing::ElementsAre;

/// The dipper's cavity is 4 m deep, its heap one more; it goes up at 2 m/s. The truck's bed is at
/// x = 20, turned by 90 degrees.
struct Scene {
  rock::LoadRegions regions;
  rock::PoseTrack dipper{{0, 1, 2, 3}, {pose(0), pose(2), pose(4), pose(6)}};
  static Pose pose(double z) { return {Quaterniond::Identity(), {0, 0, z}}; }
  Scene() {
    regions.dipper = Box{{0, -1, -1}, {5, 1, 1}};
    regions.lip_x_m = 4;
    regions.truck = Box{{-2, -1, 0}, {2, 1, 3}};
    regions.X_WT = {Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)), {20, 0, 0}};
  }
};

/// Spheres of 1 kg (unless given) with id, place and upward speed, one frame a second.
std::string ball(int id, double x, double y, double z, double vz = 0, double kg = 1, int type = 1) {
  return std::to_string(id) + " " + std::to_string(type) + " " + std::to_string(x) + " " +
         std::to_string(y) + " " + std::to_string(z) + " 0 0 " + std::to_string(vz) + " 0.1 " +
         std::to_string(kg) + "\n";
}

io::DumpFolder dumps_of(const Scratch& s, const std::vector<std::vector<std::string>>& frames) {
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::string rows;
    for (const std::string& row : frames[k]) rows += row;
    s.write("rocks_" + std::to_string(100 * k) + ".dump",
            text_frame(static_cast<long>(100 * k), static_cast<int>(frames[k].size()),
                       "id type x y z vx vy vz radius mass", rows));
  }
  return io::open_dump_folder(s.folder(), 0.01);
}

TEST(PileSurface, TheGroundIsUnderTheLowestRockOverTheFootprint) {
  const Scratch s;
  const io::DumpFolder dumps =
      dumps_of(s, {{ball(1, 0, 0, 350.1), ball(2, 1, 0, 351), ball(3, 90, 0, 300)}});
  const Footprint footprint{{-5, -5}, {5, 5}};
  EXPECT_NEAR(lowest_m(dumps.frames[0], footprint), 350, 1e-9);
  EXPECT_EQ(lowest_m(dumps.frames[0], {{-9, -9}, {-8, -8}}), 0);
}

TEST(Survey, SumsTheRockOfAFrame) {
  const Scratch s;
  const Scene scene;
  // At 1 s the dipper is at z = 2 and rises with 2 m/s.
  const io::DumpFolder d = dumps_of(
      s, {{ball(1, 9, 0, 0)},
          {ball(1, 1, 0, 2, 2.05, 3), ball(2, 2.5, 0, 2, 1.0, 5), ball(3, 5.5, 0.5, 2, 0, 7),
           ball(4, 6.5, 0, 2, 0, 11), ball(5, 20.9, 1.9, 1, 0, 13), ball(6, 21.1, 0, 1, 0, 17)}});
  const rock::FrameSums f = survey_frames(d, {}, scene.regions, scene.dipper, {}).frames.at(1);
  EXPECT_NEAR(f.rock_kg, 56, 1e-9);
  EXPECT_NEAR(f.in_dipper_kg, 8, 1e-9);
  EXPECT_NEAR(f.bulk_kg, 3, 1e-9) << "0.05 m/s against the dipper";
  EXPECT_NEAR(f.flow_kg, 5, 1e-9) << "1 m/s";
  EXPECT_NEAR(f.relative_speed_m_s(), (3 * 0.05 + 5 * 1.0) / 8, 1e-9);
  EXPECT_NEAR(f.ahead_kg, 7, 1e-9) << "within half a depth of the lip";
  EXPECT_NEAR(f.rearmost_m, 1, 1e-9);
  EXPECT_NEAR(f.in_truck_kg, 13, 1e-9) << "the bed is 2 m wide along W's x";
  EXPECT_NEAR(f.kinetic_energy_J, 0.5 * (3 * 2.05 * 2.05 + 5), 1e-9);
}

TEST(Survey, FollowsEveryRockOfALoad) {
  const Scratch s;
  const Scene scene;
  // The pile covers x 8 ... 12. Lifted at 1 s: 2 ... 6; 7 drops into the truck from elsewhere; 6 is
  // lost from the domain.
  const io::DumpFolder d =
      dumps_of(s, {{ball(1, 8, -3, 0), ball(2, 12, 3, 0, 0, 2), ball(3, 9, 0, 0, 0, 3),
                    ball(4, 9, 1, 0, 0, 4, 2), ball(5, 9, 2, 0, 0, 5), ball(6, 10, 0, 0, 0, 6),
                    ball(7, 10, 0, 1, 0, 7)},
                   {ball(1, 8, -3, 0), ball(2, 1, 0, 2, 0, 2), ball(3, 2, 0, 2, 0, 3),
                    ball(4, 3, 0, 2, 0, 4, 2), ball(5, 4.5, 0, 2, 0, 5), ball(6, 1, 0.5, 2, 0, 6),
                    ball(7, 10, 0, 1, 0, 7)},
                   {ball(1, 8, -3, 0), ball(2, 20, 0, 1, 0, 2), ball(3, 1, 0, 4, 0, 3),
                    ball(4, 11, 0, 0, 0, 4, 2), ball(5, -5, 0, 0, 0, 5), ball(7, 20, 1, 1, 0, 7)}});
  const Survey v = survey_frames(d, {}, scene.regions, scene.dipper, {{1, 2, 0}});
  ASSERT_EQ(v.fates.size(), 1u);
  const LoadFate& f = v.fates[0];
  EXPECT_NEAR(f.lifted_kg, 20, 1e-9);
  EXPECT_NEAR(f.truck_kg, 2, 1e-9);
  EXPECT_NEAR(f.carry_back_kg, 3, 1e-9);
  EXPECT_NEAR(f.back_in_pile_kg, 4, 1e-9);
  EXPECT_NEAR(f.spillage_kg, 5 + 6, 1e-9);
  EXPECT_NEAR(f.truck_from_elsewhere_kg, 7, 1e-9);
  EXPECT_NEAR(f.class_kg.at(1), 16, 1e-9);
  EXPECT_NEAR(f.class_kg.at(2), 4, 1e-9);
  EXPECT_NEAR(v.classes.at(1).mass_kg, 24, 1e-9);
}

rock::FrameSums filled(double kg, double rearmost, double ahead) {
  rock::FrameSums f;
  f.in_dipper_kg = kg;
  f.rearmost_m = rearmost;
  f.ahead_kg = ahead;
  return f;
}

TEST(Stages, BeginWhereTheRockReaches) {
  const std::vector<rock::FrameSums> frames = {
      filled(0, 0, 9),   filled(1, 3, 9),   filled(2, 2.5, 9), filled(3, 1.9, 9),
      filled(4, 1, 1),   filled(5, 0.3, 2), filled(6, 0.2, 5), filled(7, 0.1, 4),
      filled(8, 0.1, 3), filled(8, 0.1, 1)};
  std::vector<std::size_t> at;
  std::vector<int> stage;
  for (const rock::Stage& s : rock::find_stages(frames, 0, 10, 8, 4.0)) {
    at.push_back(s.frame);
    stage.push_back(s.stage);
  }
  EXPECT_THAT(stage, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(at, ElementsAre(1, 3, 5, 6, 8));
}

TEST(Stages, ThatDoNotOccurAreLeftOut) {
  const std::vector<rock::FrameSums> frames = {filled(0, 0, 0), filled(1, 3, 0), filled(1, 2.5, 0)};
  const auto stages = rock::find_stages(frames, 0, 3, 3, 4.0);
  ASSERT_EQ(stages.size(), 1u);
  EXPECT_STREQ(rock::stage_name(stages[0].stage), "lip cuts");
  EXPECT_TRUE(rock::find_stages({filled(0, 0, 0)}, 0, 1, 1, 4.0).empty());
}

}  // namespace
}  // namespace dipper::analysis::metrics
