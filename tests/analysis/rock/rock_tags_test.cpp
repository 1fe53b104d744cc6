#include "analysis/rock/rock_tags.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/input_error.hpp"
#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::rock {
namespace {

// A sphere, and two clumps of two: one of equal spheres, one with a small one.
constexpr const char* kRows =
    "7 1 -1 0 0 0 0.5 2000\n"
    "1 2 4 5 0 0 0.3 2000\n"
    "2 2 4 5.2 0 0 0.3 2000\n"
    "3 2 5 5 1 0 0.1 2000\n"
    "4 2 5 5.2 1 0 0.4 2000\n";

TEST(RockTags, GiveSizeShapeAndPlaceOfTheWholeRock) {
  const Scratch s;
  const io::DumpReader dump(
      {s.write("d.dump", text_frame(0, 5, "id type id_multisphere x y z radius density", kRows))});
  s.write("twins.spheres", "# x y z radius\n0 0 0 0.4\n0.2 0 0 0.4\n");
  s.write("pear.spheres", "0 0 0 0.4\n0.2 0 0 0.1\n");
  const auto shapes = read_shapes(s.folder());
  ASSERT_EQ(shapes.size(), 2u);
  LoadRegions regions;
  regions.dipper = Box{{4, -1, -1}, {6, 0.5, 1}};
  const ClumpMasses masses{{2, 2000 * M_PI / 6 * 0.125}};
  auto tags = tag_rocks(dump.frames()[0], masses, shapes, regions, {});
  ASSERT_EQ(tags.size(), 3u);
  const RockTag ball = tags.at(rock_key(7, -1)), twins = tags.at(rock_key(1, 4)),
                pear = tags.at(rock_key(3, 5));
  EXPECT_NEAR(ball.size_m, 1.0, 1e-12);
  EXPECT_NEAR(twins.size_m, 0.5, 1e-12);
  EXPECT_EQ(ball.shape, 0);
  EXPECT_EQ(pear.shape, 1);  // by the files' names
  EXPECT_EQ(twins.shape, 2);
  EXPECT_FALSE(ball.in_dipper);
  EXPECT_TRUE(twins.in_dipper);
  EXPECT_FALSE(pear.in_dipper);
  regions.dipper = Box{{-1, -1, -1}, {1, 1, 1}};
  EXPECT_TRUE(tag_rocks(dump.frames()[0], masses, shapes, regions, {{}, {5, 1, 0}})
                  .at(rock_key(3, 5))
                  .in_dipper);
  s.write("bad.spheres", "0 0 0\n");
  EXPECT_THROW(read_shapes(s.folder()), InputError);
}

}  // namespace
}  // namespace dipper::analysis::rock
