#include "analysis/rock/rocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::rock {
namespace {

using testing::HasSubstr;

constexpr const char* kColumns = "id type id_multisphere x y z vx vy vz radius density";
// A sphere, then a rock of two spheres whose volumes are as 1 to 8.
constexpr const char* kRows =
    "1 1 -1 1 2 3 0.5 0 0 0.1 3000\n2 2 7 0 0 0 1 0 0 0.1 3000\n3 2 7 9 0 0 1 0 9 0.2 3000\n";
constexpr double kSphere_m3 = 4.0 / 3.0 * M_PI * 1e-3;

// As deck/rocks.in is written: a template a shape, continued over lines.
constexpr const char* kDeck =
    "group spheres type 1\n\nfix d200_sphere spheres particletemplate/sphere 122663 atom_type 1 "
    "density constant 3000 &\n  radius constant 0.1\n\n"
    "fix d300_block all particletemplate/multisphere 130579 atom_type 2 density constant 3000 &\n"
    "  nspheres 6 ntry 200000 spheres file ${deck}/block.spheres scale 0.6 &\n"
    "  type 1 mass 55.5 use_density &\n  inertia_tensor 1 2 3 4 5 6\n"
    "fix grading all particledistribution/discrete/massbased 19 2 d200_sphere 0.5 d300_block 0.5\n";

std::vector<Fragment> rocks_of(const Scratch& s, const std::string& columns,
                               const std::string& rows, int particles, const ClumpMasses& masses) {
  const io::DumpReader reader({s.write("rocks_5.dump", text_frame(5, particles, columns, rows))});
  std::vector<Fragment> rocks;
  for_each_fragment(reader.frames().at(0), masses, [&](const Fragment& r) { rocks.push_back(r); });
  return rocks;
}

TEST(Rocks, AClumpIsOneRockWithItsClassMass) {
  const Scratch s;
  const ClumpMasses masses = read_clump_masses(s.write("deck/rocks.in", kDeck));
  ASSERT_EQ(masses.size(), 1u);
  const auto rocks = rocks_of(s, kColumns, kRows, 3, masses);
  ASSERT_EQ(rocks.size(), 2u);
  EXPECT_EQ(rocks[0].key, 1);
  EXPECT_NEAR(rocks[0].mass_kg, 3000 * kSphere_m3, 1e-9);
  EXPECT_EQ(rocks[1].key, -8);
  EXPECT_EQ(rocks[1].type, 2);
  EXPECT_DOUBLE_EQ(rocks[1].mass_kg, 55.5);
  EXPECT_NEAR(rocks[1].p_W.x(), 8, 1e-12);
  EXPECT_NEAR(rocks[1].v_W.z(), 8, 1e-12);
}

TEST(Rocks, WithoutADeckAClumpWeighsItsSpheres) {
  const Scratch s;
  const auto rocks = rocks_of(s, kColumns, kRows, 3, {});
  EXPECT_NEAR(rocks[1].mass_kg, 9 * 3000 * kSphere_m3, 1e-9);
}

TEST(Rocks, AMassColumnIsTakenAsItIs) {
  const Scratch s;
  const auto rocks = rocks_of(s, "id x y z radius mass", "4 0 0 0 0.1 12.5\n", 1, {});
  ASSERT_EQ(rocks.size(), 1u);
  EXPECT_DOUBLE_EQ(rocks[0].mass_kg, 12.5);
  EXPECT_EQ(rocks[0].type, 1);
}

TEST(Rocks, WhatIsMissingIsReportedWithFileAndLine) {
  const Scratch s;
  const auto wrong = [&](const char* columns, const char* row, const ClumpMasses& masses = {}) {
    return test::message_of([&] { rocks_of(s, columns, row, 1, masses); });
  };
  EXPECT_THAT(wrong("id x y z density", "1 0 0 0 3000\n"),
              HasSubstr("rocks_5.dump:9: particles without radius"));
  EXPECT_THAT(wrong("id x y z radius", "1 0 0 0 1\n"),
              HasSubstr("rocks_5.dump:9: particles without mass or density"));
  EXPECT_THAT(wrong("x y z radius density", "0 0 0 1 3000\n"),
              HasSubstr("rocks_5.dump:9: particles without id"));
  EXPECT_THAT(wrong("id x y z radius density", "6 0 0 0 0 3000\n"),
              HasSubstr("particle 6 has radius 0"));
  EXPECT_THAT(wrong(kColumns, "2 3 7 0 0 0 1 0 0 0.1 3000\n", {{2, 55.5}}),
              HasSubstr("rock 7 is of type 3, which the deck has no clump of"));
  EXPECT_THAT(test::message_of(
                  [&] { read_clump_masses(s.write("d.in", "multisphere atom_type 2 mass x\n")); }),
              HasSubstr("d.in:1: mass 'x' is not a mass"));
}

TEST(Rocks, WhatNoRockIsLikeIsRefusedWithItsParticle) {
  const Scratch s;
  const auto message = [&](const std::string& row) {
    return test::message_of([&] { rocks_of(s, kColumns, row, 1, {}); });
  };
  EXPECT_EQ(message("6 1 -1 1 2 3 0.5 0 0 0.1 3000\n"), "");
  for (const auto& [row, what] : {std::pair{"6 1 -1 1 2 3 0.5 0 0 1e5 3000\n", "radius 100000"},
                                  {"6 1 -1 1 2 3 0.5 0 0 0.1 1e30\n", "density 1e+30"},
                                  {"6 1 -1 1 2 3e7 0.5 0 0 0.1 3000\n", "position 3e+07"},
                                  {"6 1 -1 1 2 3 0.5 0 -1e99 0.1 3000\n", "velocity 1e+99"},
                                  {"6 1 1e20 1 2 3 0.5 0 0 0.1 3000\n", "id_multisphere 1e+20"},
                                  {"6 -4 -1 1 2 3 0.5 0 0 0.1 3000\n", "type -4"}})
    EXPECT_THAT(message(row), HasSubstr(std::string("rocks_5.dump:9: particle 6 has ") + what));
}

}  // namespace
}  // namespace dipper::analysis::rock
