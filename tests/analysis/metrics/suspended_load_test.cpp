// A dipper that hangs over a truck, frames a second apart.
#include "analysis/metrics/suspended_load.hpp"

#include <gtest/gtest.h>

#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::metrics {
namespace {

rock::LoadRegions regions() {
  rock::LoadRegions p;
  p.dipper = Box{{0, -1, -1}, {5, 1, 1}};
  p.truck = Box{{-2, -2, -3}, {2, 2, -1.1}};
  return p;
}

std::string ball(int id, double x, double z, double vz, double kg) {
  return std::to_string(id) + " 1 " + std::to_string(x) + " 0 " + std::to_string(z) + " 0 0 " +
         std::to_string(vz) + " 0.1 " + std::to_string(kg) + "\n";
}

io::DumpFolder dumps_of(const Scratch& s, const std::vector<std::string>& frames, int count,
                        const std::string& columns = "id type x y z vx vy vz radius mass") {
  for (std::size_t k = 0; k < frames.size(); ++k)
    s.write("rocks_" + std::to_string(100 * k) + ".dump",
            text_frame(static_cast<long>(100 * k), count, columns, frames[k]));
  return io::open_dump_folder(s.folder(), 0.01);
}

const rock::PoseTrack kStill({0, 9}, {Pose{}, Pose{}});

TEST(SuspendedLoad, WeighsWhatRidesOutsideAndWhatGainsMomentum) {
  const Scratch s;
  // Rests inside; gains 0.981 m/s in 1 s: 10 kg weigh 1 kg more; rides on the lip; falls past the
  // lip; lies in the truck below; lies too far away to be carried.
  const auto frame = [](double vz, double lip_kg) {
    return ball(1, 2, 0, 0, 50) + ball(2, 3, 0, vz, 10) + ball(3, 5.5, 0, 0.05, lip_kg) +
           ball(4, 5.6, 0, -1, 7) + ball(5, 0, -1.5, 0, 11) + ball(6, 6.5, 0, 0, 13);
  };
  const io::DumpFolder dumps = dumps_of(s, {frame(0, 4), frame(0.981, 4), frame(3, 4)}, 6);
  const auto load = suspended_load(dumps, {}, regions(), kStill, 0, 1.5);
  ASSERT_TRUE(load);
  EXPECT_NEAR(load->riding_kg, 4, 1e-9);
  ASSERT_TRUE(load->accelerating_kg);
  EXPECT_NEAR(*load->accelerating_kg, 1, 1e-6);
}

TEST(SuspendedLoad, ALoadThatIsLetDownWeighsLess) {
  const Scratch s;
  const io::DumpFolder dumps =
      dumps_of(s, {ball(1, 2, 0, 0, 100), ball(1, 2, -0.1, -0.0981, 100)}, 1);
  EXPECT_NEAR(*suspended_load(dumps, {}, regions(), kStill, 0, 2)->accelerating_kg, -1, 1e-6);
}

TEST(SuspendedLoad, OneFrameShowsNoAccelerationAndNoFrameNothing) {
  const Scratch s;
  const io::DumpFolder dumps = dumps_of(s, {ball(1, 2, 0, 0, 1), ball(1, 2, 0, 0, 1)}, 1);
  EXPECT_FALSE(suspended_load(dumps, {}, regions(), kStill, 0.5, 1.5)->accelerating_kg);
  EXPECT_FALSE(suspended_load(dumps, {}, regions(), kStill, 0.2, 0.8));
}

TEST(SuspendedLoad, NeedsVelocities) {
  const Scratch s;
  const io::DumpFolder dumps = dumps_of(s, {"1 1 2 0 0 0.1 1\n"}, 1, "id type x y z radius mass");
  EXPECT_FALSE(suspended_load(dumps, {}, regions(), kStill, 0, 1));
}

}  // namespace
}  // namespace dipper::analysis::metrics
