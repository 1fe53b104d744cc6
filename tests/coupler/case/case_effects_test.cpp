#include <gtest/gtest.h>

#include "coupler/case/effects.hpp"
#include "tests/coupler/case/checkout.hpp"
#include "tests/places.hpp"

namespace dipper::cases {
namespace {

namespace fs = std::filesystem;
using test::Checkout;
using test::write_text;

Case load(const Checkout& checkout, const std::vector<Override>& set,
          std::vector<Finding>* findings) {
  findings->clear();
  return load_case(checkout.folder(), set, *findings);
}

std::string only_message(const std::vector<Finding>& findings) {
  EXPECT_EQ(findings.size(), 1U);
  return findings.empty() ? "" : to_string(findings[0]);
}

/// An effect of the checkout's own, on the rock.
void add_effect(const Checkout& checkout, const std::string& name, const std::string& overlay) {
  fs::create_directories(checkout.folder() / "effects");
  write_text(checkout.folder() / "effects" / (name + ".yaml"),
             "title: t\nkind: rock\n"
             "parameter: {name: p, unit: m, low: -1, high: 2, scale: 1, source: s}\n"
             "overlay:\n" +
                 overlay);
}

TEST(Effects, EveryFileOfTheCatalogueIsSoundAndAppliesAtBothItsBounds) {
  const Checkout checkout;
  std::vector<Finding> findings;
  const Case plain = load(checkout, {}, &findings);
  const auto names = effect_names(checkout.folder());
  EXPECT_GE(names.size(), 12U);
  const std::string page = test::read_text(test::source() / "docs/case.md");
  for (const std::string& name : names) {
    EXPECT_NE(page.find("| `" + name + "` |"), std::string::npos) << "no row in docs/case.md";
    const Effect e = read_effect(effect_file(checkout.folder(), name), findings);
    EXPECT_TRUE(findings.empty()) << name << ": " << to_string(findings[0]);
    for (const double strength : {e.low, e.high}) {
      const Case c = load(checkout, {{"effects." + name, std::to_string(strength)}}, &findings);
      EXPECT_TRUE(findings.empty()) << name << ": " << to_string(findings[0]);
      EXPECT_EQ(c.text != plain.text, strength != 0) << name;
    }
  }
}

TEST(Effects, AddScaleAndSetChangeTheValuesAndTheTextAlone) {
  const Checkout checkout;
  add_effect(checkout, "mine",
             "  rock.classes.#.size_m: {scale: 0.5}\n"
             "  machine.base_position_m.2: {add: 3}\n"
             "  rock.density_kg_m3: {set: 2000}\n");
  std::vector<Finding> findings;
  const Case plain = load(checkout, {}, &findings);
  const Case c = load(checkout, {{"effects.mine", "1.5"}}, &findings);
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  for (std::size_t i = 0; i < c.rock.classes.size(); ++i) {
    EXPECT_DOUBLE_EQ(c.rock.classes[i].size_m, 1.75 * plain.rock.classes[i].size_m);
  }
  EXPECT_DOUBLE_EQ(c.machine.base_position_m.z(), plain.machine.base_position_m.z() + 4.5);
  EXPECT_DOUBLE_EQ(c.rock.density_kg_m3, 3000);
  EXPECT_NE(c.text.find("rock.density_kg_m3=3000\n"), std::string::npos);
  EXPECT_EQ(c.text.find("effects"), std::string::npos);
  EXPECT_EQ(load(checkout, {{"effects.mine", "0"}}, &findings).text, plain.text);
}

TEST(Effects, OnASieveAreRefused) {
  const Checkout checkout;
  add_effect(checkout, "top", "  rock.sieve.max_size_m: {add: 1}\n");
  std::vector<Finding> findings;
  load(checkout, {{"effects.top", "0.2"}}, &findings);
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(to_string(findings[0]).find("rock.sieve.max_size_m: is read before effects"),
            std::string::npos);
}

TEST(Effects, ALawIsMadeOfTermsOfTheMotion) {
  const Checkout checkout;
  fs::create_directories(checkout.folder() / "effects");
  const std::string head =
      "title: t\nkind: observation\n"
      "parameter: {name: size, unit: m, low: 0, high: 2, scale: 1, source: s}\noverlay:\n";
  const fs::path file = checkout.folder() / "effects/law.yaml";
  write_text(file, head +
                       "  observation.crowd_law.crowd_out_kN: {add: 90}\n"
                       "  observation.crowd_law.crowd_in_kN: {add: -90}\n");
  std::vector<Finding> findings;
  const Case c = load(checkout, {{"effects.law", "0.5"}}, &findings);
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  EXPECT_EQ(c.observation.crowd_law,
            (std::map<std::string, double>{{"crowd_in_kN", -45}, {"crowd_out_kN", 45}}));
  EXPECT_NE(c.text.find("observation.crowd_law.crowd_in_kN=-45\n"), std::string::npos);

  write_text(file, head + "  observation.crowd_law.crowd_aut_kN: {add: 90}\n");
  load(checkout, {{"effects.law", "1"}}, &findings);
  EXPECT_NE(only_message(findings).find("is not a term of the motion; did you mean crowd_out_kN?"),
            std::string::npos);
  load(checkout, {{"observation.hoist_law.weight_kN", "1"}}, &findings);
  EXPECT_NE(only_message(findings).find("is not a term of the motion"), std::string::npos);
}

TEST(Effects, ANumberThatFollowsAnotherFollowsItsChange) {
  const Checkout checkout;
  fs::create_directories(checkout.folder() / "effects");
  write_text(checkout.folder() / "effects/mine.yaml",
             "title: t\nkind: rock\n"
             "parameter: {name: p, unit: '-', low: 0, high: 1, scale: 1, source: s}\n"
             "overlay:\n"
             "  contact.normal_damping: {add: 0.1}\n"
             "  contact.friction_truck_sphere: {add: 0.1}\n");
  std::vector<Finding> findings;
  const ContactCase plain = load(checkout, {}, &findings).contact;
  const ContactCase c = load(checkout, {{"effects.mine", "1"}}, &findings).contact;
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  EXPECT_DOUBLE_EQ(*c.normal_damping_other, *plain.normal_damping_other + 0.1);
  EXPECT_DOUBLE_EQ(*c.friction_truck_sphere, plain.friction_truck + 0.1);
  EXPECT_EQ(c.friction_truck, plain.friction_truck);
}

TEST(Effects, SayWhatIsWrongWithThem) {
  const Checkout checkout;
  std::vector<Finding> findings;
  load(checkout, {{"effects.crowd_frictoin", "1"}}, &findings);
  EXPECT_NE(only_message(findings).find("did you mean crowd_friction?"), std::string::npos);
  load(checkout, {{"effects.crowd_friction", "5000"}}, &findings);
  EXPECT_NE(only_message(findings).find("allowed is 0 ... 400 kN"), std::string::npos);
  load(checkout, {{"effects.standoff", "nan"}}, &findings);
  EXPECT_NE(only_message(findings).find("write a number"), std::string::npos);

  fs::create_directories(checkout.folder() / "effects");
  write_text(checkout.folder() / "effects/bad.yaml",
             "title: t\nkind: wind\n"
             "parameter: {name: p, unit: m, low: 1, high: 2, source: s}\n"
             "overlay:\n"
             "  rock.density_kg_m3: {multiply: 2}\n");
  load(checkout, {{"effects.bad", "1"}}, &findings);
  ASSERT_EQ(findings.size(), 4U);
  EXPECT_NE(to_string(findings[0]).find("bad.yaml:2: kind: is 'wind'"), std::string::npos);
  EXPECT_NE(to_string(findings[1]).find("scale: missing"), std::string::npos);
  EXPECT_NE(to_string(findings[2]).find("must contain 0"), std::string::npos);
  EXPECT_NE(to_string(findings[3]).find("bad.yaml:5: overlay.rock.density_kg_m3: write one of"),
            std::string::npos);
}

TEST(Effects, RefusesTwoThatChangeOneValueAndAValueThatLeavesItsRange) {
  const Checkout checkout;
  std::vector<Finding> findings;
  fs::create_directories(checkout.folder() / "effects");
  const std::string head =
      "title: t\nkind: rock\n"
      "parameter: {name: p, unit: m, low: -9, high: 9, scale: 1, source: s}\noverlay:\n";
  write_text(checkout.folder() / "effects/one.yaml", head + "  pile.height_m: {add: 1}\n");
  load(checkout, {{"effects.one", "1"}, {"effects.pile_height", "1"}}, &findings);
  EXPECT_NE(only_message(findings).find("changes pile.height_m, as effects.one does"),
            std::string::npos);
  load(checkout, {{"effects.one", "-9"}}, &findings);
  EXPECT_NE(only_message(findings).find("makes pile.height_m = -1; allowed is > 0"),
            std::string::npos);
  write_text(checkout.folder() / "effects/one.yaml", head + "  pile.hight_m: {add: 1}\n");
  load(checkout, {{"effects.one", "1"}}, &findings);
  EXPECT_NE(only_message(findings).find("one.yaml:5: pile.hight_m: is not a number of the case"),
            std::string::npos);
}

}  // namespace
}  // namespace dipper::cases
