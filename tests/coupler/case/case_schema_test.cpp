#include <gtest/gtest.h>

#include <map>
#include <set>

#include "coupler/case/schema.hpp"
#include "tests/coupler/case/checkout.hpp"
#include "tests/places.hpp"

namespace dipper::cases {
namespace {

TEST(Schema, KeysAreUniqueAndCarryTheirUnit) {
  std::set<std::string> keys;
  for (const KeySpec& spec : schema()) {
    EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
    EXPECT_FALSE(spec.doc.empty()) << spec.key;
    EXPECT_EQ(spec.stem() + unit_suffix(spec.unit), spec.leaf());
  }
}

TEST(Schema, DocsListEveryKeyAsItIs) {
  const std::string docs = test::read_text(test::source() / "docs/case.md");
  EXPECT_NE(docs.find(schema_markdown()), std::string::npos)
      << "docs/case.md is behind; its table of keys is:\n"
      << schema_markdown();
}

TEST(Schema, Ranges) {
  EXPECT_EQ((Range{0, 1e300, true, false}.text()), "> 0");
  EXPECT_EQ((Range{0, 1e300, false, false}.text()), ">= 0");
  EXPECT_EQ((Range{0, 0.5, true, true}.text()), "> 0 and < 0.5");
  EXPECT_EQ((Range{-360, 360, false, false}.text()), "-360 ... 360");
  EXPECT_EQ(Range{}.text(), "");
  EXPECT_FALSE((Range{0, 1, true, true}.holds(0)));
  EXPECT_FALSE((Range{0, 1, true, true}.holds(1)));
  EXPECT_TRUE((Range{0, 1, false, false}.holds(0)));
}

TEST(Schema, KnowsWhatAKeyAffects) {
  const std::map<std::string, std::vector<const char*>> known = {
      {"settling",
       {"seed", "rock.density_kg_m3", "rock.classes.#.size_m", "rock.sieve.file",
        "contact.rolling_friction_truck", "pile.settle_s", "domain.max_m", "dem.timestep_s",
        "dem.ranks", "dem.loop", "effects.*"}},
      {"dig",
       {"machine.motion", "machine.rake_angle_deg", "machine.rope_compliance",
        "machine.carry_back_m", "bodies.*", "truck.mesh", "truck.heading_deg", "crust.above_m",
        "collapse.at_s", "coupling.scheme", "coupling.sync_steps", "dem.hold_below_m_s",
        "pile.clear_machine", "pile.held_layer_m", "pile.clean_floor_to_x_m", "output.wear_m3_J"}},
      {"machine", {"machine.crowd_friction_N", "machine.hoist_loss"}},
      {"output",
       {"title", "end_s", "coupling.timeout_s", "output.dump_every_s", "output.checkpoint_every_s",
        "output.wall_stress"}}};
  for (const auto& [affects, keys] : known)
    for (const char* key : keys) EXPECT_EQ(to_string(find_spec(key)->affects), affects) << key;
}

TEST(Schema, WholeSectionsAffectTheSame) {
  // A key that is forgotten here would leave a pile of another rock in use.
  const std::map<std::string, Affects> sections = {
      {"rock.", Affects::settling}, {"contact.", Affects::settling}, {"domain.", Affects::settling},
      {"truck.", Affects::dig},     {"crust.", Affects::dig},        {"collapse.", Affects::dig}};
  for (const KeySpec& spec : schema()) {
    for (const auto& [section, affects] : sections)
      if (spec.key.rfind(section, 0) == 0) {
        EXPECT_EQ(spec.affects, affects) << spec.key;
      }
    // `dipper observe` takes those of the section, and no other.
    EXPECT_EQ(spec.affects == Affects::instruments, spec.key.rfind("observation.", 0) == 0)
        << spec.key;
  }
}

TEST(Schema, KnowsTheKeysOfACasesText) {
  EXPECT_EQ(spec_of("rock.classes.12.name"), find_spec("rock.classes.#.name"));
  EXPECT_EQ(spec_of("bodies.dipper"), find_spec("bodies.*"));
  EXPECT_EQ(spec_of("seed"), find_spec("seed"));
  EXPECT_EQ(spec_of("machine.base_position_m.0"), find_spec("machine.base_position_m"));
  EXPECT_EQ(spec_of("rock.classes.#.size_m"), find_spec("rock.classes.#.size_m"));
  for (const char* none : {"rock", "rock.classes.x.name", "rock.density", "seeds", "bodies."})
    EXPECT_EQ(spec_of(none), nullptr) << none;
  EXPECT_TRUE(is_path(*find_spec("bodies.*")));
  EXPECT_FALSE(is_path(*find_spec("title")));
}

TEST(Schema, HasTheWordOfAChoice) {
  Case c;
  EXPECT_EQ(word_of(c, "machine.contact_on_return"), "on");
  EXPECT_EQ(word_of(c, "coupling.scheme"), "corrected");
  EXPECT_EQ(word_of(c, "dem.loop"), "fast");
  c.machine.drives = machine::DriveMode::limited;
  EXPECT_EQ(word_of(c, "machine.drives"), "limited");
}

}  // namespace
}  // namespace dipper::cases
