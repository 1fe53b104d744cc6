#include "analysis/rock/frame_faults.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "analysis/rock/rocks.hpp"
#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::rock {
namespace {

using testing::HasSubstr;

/// The refusal of thirty spheres of 0.1 m in a box of 10 x 20 x 10 m, changed; empty: none.
std::string refusal(double id_scale, double radius_scale, double position_scale,
                    const std::string& columns = "id x y z radius density", int particles = 30) {
  const Scratch s;
  std::string rows;
  for (int i = 0; i < particles; ++i)
    rows +=
        fmt::format("{} {} {} {} {} 3000\n", id_scale * (i + 1), position_scale * (1 + 0.25 * i),
                    position_scale * 2, position_scale * 3, radius_scale * 0.1);
  const io::DumpReader reader({s.write("rocks_5.dump", text_frame(5, particles, columns, rows))});
  return test::message_of(
      [&] { for_each_fragment(reader.frames().at(0), {}, [](const Fragment&) {}); });
}

TEST(FrameFaults, SoundSpheresHaveNone) { EXPECT_EQ(refusal(1, 1, 1), ""); }

TEST(FrameFaults, IdsThatAreNoNames) {
  EXPECT_THAT(refusal(0.5, 1, 1), HasSubstr("rocks_5.dump:9: id 0.5 is not a whole number"));
  EXPECT_THAT(refusal(0, 1, 1), HasSubstr("rocks_5.dump:9: id 0 occurs twice in the frame of"));
  EXPECT_EQ(refusal(-1e9, 1, 1), "");
}

TEST(FrameFaults, OtherUnits) {
  EXPECT_THAT(refusal(1, 1000, 1), HasSubstr("do not fit into the box of 10 x 20 x 10 m: is the "
                                             "radius in mm?"));
  EXPECT_THAT(refusal(1, 1, 1000), HasSubstr("30 of 30 particles are outside the box of 10 x 20"));
  EXPECT_EQ(refusal(1, 10, 1), "") << "rocks of 1 m";
  EXPECT_EQ(refusal(1, 1, 1000, "id x y z radius density", 3), "");
  EXPECT_EQ(refusal(1, 1, 1000, "id xu yu zu radius density"), "") << "they may leave the box";
}

}  // namespace
}  // namespace dipper::analysis::rock
