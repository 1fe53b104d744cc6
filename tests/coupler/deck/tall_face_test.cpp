// A bench cut to a profile that is steeper than rock stands: 60 degrees, 5 m high. The cut gives
// it; what relaxing takes of it is measured as in a run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupler/deck/deck.hpp"
#include "coupler/result/achieved_profile.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/coupler/deck/settled_bench.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;

constexpr double kFace_deg = 60, kHeight = 5, kRock = 0.4;

cases::Case steep_case() {
  cases::Case c = tiny_case();
  const double toe = 13, crest = toe + kHeight / std::tan(kFace_deg * M_PI / 180);
  c.pile.profile = "scan.csv";
  c.pile.outline_m = {{toe, 0}, {crest, kHeight}, {crest + 2.5, kHeight}};
  c.rock.classes = {{"d200", kRock / c.rock.coarse_graining, 100, {"sphere"}}};
  return c;
}

result::AchievedProfile settled(const fs::path& folder, double relax_s) {
  const auto found = result::achieved_profile(steep_case(), settled_bench(folder, relax_s));
  EXPECT_TRUE(found);
  return found.value_or(result::AchievedProfile{});
}

TEST(TallFace, IsReproducedAtTheCut) {
  const fs::path folder = fresh_folder("tall_face");
  write_deck(steep_case(), test::source() / "meshes/rocks", folder / "deck");
  const result::AchievedProfile cut = settled(folder, 0), relaxed = settled(folder, 1.5);
  for (const auto& [name, f] : {std::pair{"cut", cut}, std::pair{"relaxed 1.5 s", relaxed}})
    fmt::print(
        "{}: face {:.1f} deg; {:.2f} m below the profile in the mean, {:.2f} m at x = {:.1f}\n",
        name, f.face_deg.value(), f.below_mean_m, f.below_most_m, f.below_most_x_m);
  EXPECT_NEAR(cut.face_deg.value(), kFace_deg, 4);
  // A rock stays when its centre is under the outline: the surface seen from above, tops and the
  // hollows between them, lies about it.
  EXPECT_LT(std::abs(cut.below_mean_m), kRock / 2);
  EXPECT_LT(cut.below_most_m, kRock);
  // No dry rock stands at 60 degrees: the crest comes down.
  EXPECT_GT(relaxed.below_most_m, 1.5 * kRock);
  EXPECT_GT(relaxed.below_mean_m, cut.below_mean_m + kRock / 2);
  fs::remove_all(folder);
}

// A surface by hand: a grid of small balls under a plane, with a trench.
TEST(TallFace, ProfileOfKnownRock) {
  const fs::path folder = fresh_folder("known_profile");
  cases::Case c = quick_case();
  c.rock.coarse_graining = 1;
  c.rock.classes = {{"d200", 0.2, 100, {"sphere"}}};
  c.pile.profile = "scan.csv";
  c.pile.outline_m = {{0, 3}, {4, 3}};
  EXPECT_FALSE(result::achieved_profile(c, folder));
  std::string rows;
  int n = 0;
  for (double x = 0.05; x < 4; x += 0.1)
    for (double y = 0; y < 1; y += 0.1) {
      const double top = x > 2 && x < 2.4 ? 2.0 : 2.9;  // 0.1 m lower, and 1 m for a tenth of x
      rows += fmt::format("{} 1 {} {} {} 0.1\n", ++n, x, y, top - 0.1);
    }
  std::ofstream(folder / "rocks_0.dump")
      << "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n"
      << n << "\nITEM: BOX BOUNDS ff ff ff\n-1 5\n-1 5\n-1 5\nITEM: ATOMS id type x y z radius\n"
      << rows;
  const auto found = result::achieved_profile(c, folder);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->below_mean_m, 0.1 + 0.9 * 0.1, 0.04);  // balls reach over the trench's rims
  EXPECT_NEAR(found->below_most_m, 1.0, 0.04);
  EXPECT_NEAR(found->below_most_x_m, 2.2, 0.1);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dipper::deck
