// dem_in/default is what write_deck gives for quick_case(). DIPPER_UPDATE=1 writes it anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/deck_names.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::deck {
namespace {

namespace fs = std::filesystem;
const fs::path kSource = test::source();

std::set<std::string> names(const fs::path& folder) {
  std::set<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder)) out.insert(entry.path().filename());
  return out;
}

TEST(DefaultDeck, IsUpToDate) {
  const fs::path kept = kSource / "dem_in/default", shapes = kSource / "meshes/rocks";
  if (std::getenv("DIPPER_UPDATE") != nullptr) {
    fs::remove_all(kept);
    write_deck(quick_case(), shapes, kept);
  }
  const fs::path fresh = fresh_folder("default");
  write_deck(quick_case(), shapes, fresh);
  EXPECT_EQ(names(fresh), names(kept));
  for (const std::string& name : names(fresh))
    EXPECT_EQ(read_text(fresh / name), read_text(kept / name)) << name;
}

TEST(DefaultDeck, ClassesHoldTheirShareOfTheMass) {
  const cases::Case c = quick_case();
  const std::vector<ClassCount> counts = rock_counts(c);
  const std::vector<RockClass> classes = rock_classes(c);
  ASSERT_EQ(counts.size(), c.rock.classes.size());
  double all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) all += counts[i].rocks * classes[i].mass_kg;
  EXPECT_NEAR(all, pile_shape(c).mass_kg, 1e-9 * all);
  for (std::size_t i = 0; i < counts.size(); ++i)
    EXPECT_NEAR(counts[i].rocks * classes[i].mass_kg / all, c.rock.classes[i].mass_percent / 100,
                1e-9)
        << counts[i].name;
}

TEST(DefaultDeck, RefusesAPileWithoutItsLargestRock) {
  const cases::Case c = quick_case();
  cases::Case few = c;
  few.rock.coarse_graining = 12;
  EXPECT_THROW(write_deck(few, kSource / "meshes/rocks", fresh_folder("few")),
               std::invalid_argument);
}

TEST(DefaultDeck, HasAWallForEachBodyOfTheCaseAndTheTruckWhereThereIsOne) {
  cases::Case c = quick_case();
  c.bodies = {{"blade", c.bodies.at("dipper")}};
  c.truck.mesh.clear();
  const fs::path folder = fresh_folder("bodies");
  write_deck(c, kSource / "meshes/rocks", folder);
  const std::string walls = read_text(folder / "walls.in");
  EXPECT_NE(walls.find("fix blade all mesh/surface/stress"), std::string::npos);
  EXPECT_NE(walls.find("n_meshes 2 meshes sides blade"), std::string::npos);
  EXPECT_EQ(walls.find("truck"), std::string::npos);
}

TEST(DefaultDeck, KnowsEveryNameThatTheScriptsUse) {
  const fs::path folder = fresh_folder("names");
  write_deck(quick_case(), kSource / "meshes/rocks", folder);
  std::string scripts;
  for (const fs::path& from : {kSource / "dem_in", folder})
    for (const auto& file : fs::directory_iterator(from))
      if (file.path().extension() == ".in" && file.path().stem() != "rocks" &&
          file.path().filename().string().rfind("calibrate", 0) != 0 &&
          file.path().stem() != "contact")
        scripts += read_text(file);
  const std::regex used("\\n(?:(?:fix|dump|group) +(\\w+)|variable +(\\w+)_(?:x|y|z|mesh)) ");
  int names = 0;
  for (std::sregex_iterator at(scripts.begin(), scripts.end(), used), end; at != end; ++at) {
    const std::string name = (*at)[1].matched ? (*at)[1] : (*at)[2];
    if (name == "dipper" || name == "door") continue;  // bodies
    EXPECT_TRUE(is_deck_name(name)) << name;
    ++names;
  }
  EXPECT_GT(names, 20);
}

}  // namespace
}  // namespace dipper::deck
