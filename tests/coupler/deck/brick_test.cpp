#include "coupler/deck/brick.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "common/angles.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

using setup::PlacedRock;

const std::map<std::string, RockShape>& shapes() {
  static const auto all = used_shapes(quick_case(), test::source() / "meshes/rocks");
  return all;
}

struct Brick {
  explicit Brick(const cases::Case& c)
      : kinds(rock_kinds(c, shapes())), shape(brick_shape(c)), rocks(loose_brick(kinds, shape)) {}
  std::vector<RockKind> kinds;
  BrickShape shape;
  std::vector<PlacedRock> rocks;

  const RockKind& kind(const PlacedRock& rock) const {
    return *std::find_if(kinds.begin(), kinds.end(),
                         [&](const RockKind& k) { return k.name == rock.kind; });
  }
  std::vector<Sphere> spheres() const {
    std::vector<Sphere> all;
    for (const PlacedRock& rock : rocks)
      for (const Sphere& s : kind(rock).spheres)
        all.push_back({rock.X_WR * s.centre_m, s.radius_m});
    return all;
  }
};

bool same(const std::vector<PlacedRock>& a, const std::vector<PlacedRock>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.kind == q.kind && p.X_WR.p == q.X_WR.p && p.X_WR.R.coeffs() == q.X_WR.R.coeffs();
  });
}

/// The names of a deck's variables: those it sets, or those it uses.
std::set<std::string> variables(const std::string& deck, const std::regex& pattern) {
  std::set<std::string> names;
  for (std::sregex_iterator at(deck.begin(), deck.end(), pattern), end; at != end; ++at)
    names.insert((*at)[1]);
  return names;
}

TEST(Brick, DeckSetsWhatItsRockUses) {
  const std::filesystem::path deck = fresh_folder("brick_deck");
  cases::Case c = tiny_case();
  for (const double cohesion_Pa : {0.0, 3000.0}) {
    c.contact.cohesion_Pa = cohesion_Pa;
    write_brick_deck(c, shapes(), deck);
    std::set<std::string> used =
        variables(read_text(deck / "material.in") + read_text(deck / "rocks.in"),
                  std::regex("\\$\\{(\\w+)\\}"));
    used.erase("deck");
    const std::set<std::string> set =
        variables(read_text(deck / "case.in"), std::regex("variable (\\w+)"));
    for (const std::string& name : used) EXPECT_EQ(set.count(name), 1U) << name << cohesion_Pa;
  }
}

TEST(Brick, SizesComeFromTheRockAndTheHeight) {
  const cases::Case c = tiny_case();
  const BrickShape s = brick_shape(c);
  EXPECT_DOUBLE_EQ(s.side_m, 8 * 0.8);
  EXPECT_DOUBLE_EQ(s.height_m, 3);
  EXPECT_DOUBLE_EQ(s.mass_kg, 1.1 * 0.60 * c.rock.density_kg_m3 * s.side_m * s.side_m * s.height_m);
  cases::Case other = c;
  other.pile.height_m = 2.2;
  other.pile.width_m = 20;
  EXPECT_DOUBLE_EQ(brick_shape(other).mass_kg, s.mass_kg);
}

TEST(Brick, SeedsShareFewBricks) {
  cases::Case c = tiny_case();
  std::map<int, int> bricks;
  for (c.seed = 1; c.seed <= 12; ++c.seed) ++bricks[brick_shape(c).number];
  EXPECT_EQ(bricks.size(), 4U);
}

TEST(Brick, LooseRockOverlapsNowhereNotAcrossTheSides) {
  const Brick brick(tiny_case());
  const std::vector<Sphere> spheres = brick.spheres();
  ASSERT_GT(brick.rocks.size(), 300U);
  std::size_t rock_of_i = 0, left = brick.kind(brick.rocks[0]).spheres.size();
  for (std::size_t i = 0; i < spheres.size(); ++i, --left) {
    if (left == 0) left = brick.kind(brick.rocks[++rock_of_i]).spheres.size();
    EXPECT_GE(spheres[i].centre_m.z(), spheres[i].radius_m);
    for (std::size_t j = i + left; j < spheres.size(); ++j) {  // of other rocks
      Vector3d apart = spheres[j].centre_m - spheres[i].centre_m;
      for (int k = 0; k < 2; ++k) apart[k] = std::remainder(apart[k], brick.shape.side_m);
      ASSERT_GE(apart.norm(), spheres[i].radius_m + spheres[j].radius_m - 1e-12);
    }
  }
}

TEST(Brick, HoldsEachClassByItsShare) {
  const cases::Case c = tiny_case();
  const Brick brick(c);
  std::map<std::string, double> mass;
  double all = 0;
  for (const PlacedRock& rock : brick.rocks) {
    const double kg = brick.kind(rock).mass_kg;
    mass[rock.kind.substr(0, 4)] += kg;
    all += kg;
  }
  EXPECT_NEAR(all, brick.shape.mass_kg, brick.kinds.back().mass_kg);
  for (const cases::SizeClass& s : c.rock.classes)
    EXPECT_NEAR(100 * mass[s.name] / all, s.mass_percent, 0.3) << s.name;
}

TEST(Brick, SameSeedSameBrickAndOthersDiffer) {
  cases::Case c = tiny_case();
  const Brick first(c);
  EXPECT_TRUE(same(first.rocks, Brick(c).rocks));
  ++c.seed;
  EXPECT_FALSE(same(first.rocks, Brick(c).rocks));
}

TEST(Brick, SaysWhichRockFindsNoRoom) {
  const Brick brick(tiny_case());
  BrickShape crowded = brick.shape;
  crowded.mass_kg *= 4;
  try {
    loose_brick(brick.kinds, crowded);
    FAIL() << "placed";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("of 6.4 m has no room for its rocks of kind d"),
              std::string::npos)
        << e.what();
  }
}

/// Rocks on a lattice of `n` a side, in the middle of the brick's height.
std::vector<PlacedRock> lattice(double side, int n) {
  std::vector<PlacedRock> rocks;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      rocks.push_back({"k", {Quaterniond::Identity(), {side * i / n, side * j / n, 1}}});
  return rocks;
}

/// Of those rocks: points but for their name.
const std::vector<RockKind> kPoints = {{"k", 1, 1, {{Vector3d::Zero(), 0.01}}, 0.01}};

TEST(LaidBench, IsOneBedWithoutSeam) {
  // A lattice that fits the brick goes on across its sides: in the bench every rock but those at
  // the edges has its four neighbours, wherever the cut lies.
  const cases::Case c = tiny_case();
  const BrickShape shape = brick_shape(c);
  const double step = shape.side_m / 8;
  for (const std::int64_t seed : {1, 2, 3}) {
    const BrickLay lay = brick_lay(seed, shape);
    const auto bench = laid_bench(lattice(shape.side_m, 8), kPoints, shape, lay, c,
                                  [](double, double) { return 2.0; });
    const PileShape pile = pile_shape(c);
    const double area = c.pile.width_m * (pile.rear_x_m - pile.toe_x_m);
    EXPECT_NEAR(static_cast<double>(bench.size()), area / (step * step), 6) << seed;
    for (const PlacedRock& rock : bench) {
      const Vector3d& p = rock.X_WR.p;
      EXPECT_NEAR(rotation_vector(rock.X_WR.R).z(), std::remainder(lay.turn_rad, 2 * radians(180)),
                  1e-12);
      if (p.x() - pile.toe_x_m < step || pile.rear_x_m - p.x() < step ||
          c.pile.width_m / 2 - std::abs(p.y()) < step)
        continue;
      int neighbours = 0;
      for (const PlacedRock& other : bench) {
        const double apart = (other.X_WR.p - p).norm();
        if (apart > 1e-9 && apart < step * 1.001) ++neighbours;
      }
      EXPECT_EQ(neighbours, 4) << p.transpose();
    }
  }
}

TEST(LaidBench, IsCutByTheRocksCentres) {
  const cases::Case c = tiny_case();
  const BrickShape shape = brick_shape(c);
  const PileShape pile = pile_shape(c);
  const auto rocks = lattice(shape.side_m, 40);
  const BrickLay lay = brick_lay(1, shape);
  // 1.1 m with what is laid in excess, over the rocks at 1 m, at x = 16
  const auto ramp = [](double x, double) { return (x - 14) * 0.5 / 1.1; };
  const auto bench = laid_bench(rocks, kPoints, shape, lay, c, ramp);
  ASSERT_FALSE(bench.empty());
  double first = 1e9;
  for (const PlacedRock& rock : bench) first = std::min(first, rock.X_WR.p.x());
  EXPECT_NEAR(first, 16, 0.2);
  for (const PlacedRock& rock : bench) {
    EXPECT_LE(rock.X_WR.p.z(), 1.1 * ramp(rock.X_WR.p.x(), 0) + 1e-12);
    EXPECT_LE(rock.X_WR.p.x(), pile.rear_x_m);
    EXPECT_LE(std::abs(rock.X_WR.p.y()), c.pile.width_m / 2);
  }
}

TEST(LaidBench, RocksThatTheWallsCutAreLeftOut) {
  const cases::Case c = tiny_case();
  const Brick brick(c);
  const double half = c.pile.width_m / 2, rear = pile_shape(c).rear_x_m;
  std::size_t near = 0;
  const auto bench = laid_bench(brick.rocks, brick.kinds, brick.shape, brick_lay(1, brick.shape), c,
                                [](double, double) { return 10.0; });
  for (const PlacedRock& rock : bench)
    for (const Sphere& s : brick.kind(rock).spheres) {
      const Vector3d at = rock.X_WR * s.centre_m;
      ASSERT_LE(std::abs(at.y()) + s.radius_m, half);
      ASSERT_LE(at.x() + s.radius_m, rear);
      if (half - std::abs(at.y()) - s.radius_m < 0.1) ++near;
    }
  EXPECT_GT(near, 5U);
}

TEST(LaidBench, SeedsCutAtOtherPlacesAndNeverAlongTheBench) {
  const BrickShape shape = brick_shape(tiny_case());
  for (std::int64_t seed = 0; seed < 200; ++seed) {
    const BrickLay a = brick_lay(seed, shape), b = brick_lay(seed + kBricks, shape);
    EXPECT_NE(a.turn_rad, b.turn_rad);
    EXPECT_NE(a.shift_m, b.shift_m);
    const double from_row = std::abs(std::remainder(degrees(a.turn_rad), 90));
    EXPECT_GE(from_row, 15 - 1e-9);
    EXPECT_EQ(a.turn_rad, brick_lay(seed, shape).turn_rad);
  }
}

}  // namespace
}  // namespace dipper::deck
