#include "coupler/check/warnings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/angles.hpp"
#include "common/frames.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/check/check.hpp"
#include "coupler/check/dig_sweep.hpp"
#include "machine/kinematics.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::check {
namespace {

using test::Checkout;
using testing::ElementsAre;
using testing::HasSubstr;

/// "key: message" of every warning; those of a pass that cannot fill the dipper or dumps nothing
/// only when asked for, as most checkouts have the motion's first rows alone.
std::vector<std::string> messages(const cases::Case& c, bool of_passes = false) {
  std::vector<std::string> said;
  for (const Finding& warning : warnings(c))
    if (of_passes || (warning.message.find("cannot fill") == std::string::npos &&
                      warning.message.find("never opens") == std::string::npos))
      said.push_back(warning.key + ": " + warning.message);
  return said;
}

/// "key: message" of every warning about a folder of the repository, with changes.
std::vector<std::string> messages_of(const std::string& folder,
                                     const std::vector<cases::Override>& set) {
  std::vector<Finding> findings;
  return messages(cases::load_case(test::source() / folder, set, findings));
}

/// "key: message" of every warning about `quick` with changes, whose own rock bridges its dipper.
std::vector<std::string> warnings_of(const Checkout& checkout,
                                     std::vector<cases::Override> set = {}, bool limited = true) {
  if (limited) set.push_back({"rock.coarse_graining_limit_m", "1"});
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), set, findings);
  test::expect_findings(findings, {});
  test::expect_findings(check_case(c), {});
  return messages(c);
}

/// The dipper's mesh changed.
template <typename Change>
std::vector<std::string> with_dipper(const Change& change, const std::string& facts = "") {
  const Checkout checkout;
  std::vector<Finding> findings;
  auto file = cases::load_case(checkout.folder(), {}, findings).bodies.at("dipper");
  mesh::TriangleMesh dipper = mesh::read_stl(file);
  for (Vector3d& v : dipper.vertices) v = change(v);
  test::write_text(checkout.folder() / "changed.stl", test::ascii_stl(dipper));
  test::write_text(checkout.folder() / "changed.yaml",
                   facts.empty() ? test::read_text(file.replace_extension(".yaml")) : facts);
  std::vector<Finding> loaded;
  cases::Case c =
      cases::load_case(checkout.folder(), {{"rock.coarse_graining_limit_m", "1"}}, loaded);
  c.bodies.at("dipper") = checkout.folder() / "changed.stl";
  return messages(c);
}

// machine.motion is then only where the run starts; here it has three passes of another case.
TEST(Warnings, AreOfTheFirstPassThatAnOperatorPlans) {
  const auto quick = [](std::vector<cases::Override> set) {
    set.push_back({"machine.motion", "../aitik/motion.csv"});
    std::vector<Finding> findings;
    cases::Case c = cases::load_case(test::source() / "cases/quick", set, findings);
    test::expect_findings(findings, {});
    return c;
  };
  const cases::Case planned = quick({});
  const CaseParts parts(planned);
  EXPECT_EQ(parts.dug.none, "");
  const auto sweeps = dig_sweeps(parts);
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_NEAR(sweeps[0].volume_m3, 55, 3);

  const cases::Case none = quick({{"machine.base_position_m", "[-5, 0, 0]"}});
  EXPECT_THAT(messages(none, true),
              testing::Contains(HasSubstr(
                  "machine.plan: on the bench as the case makes it the operator finds no dig")));
}

TEST(Warnings, SoundCaseHasNone) { EXPECT_THAT(warnings_of(Checkout(true)), ElementsAre()); }

TEST(Warnings, MachineAndTruckInThePile) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"pile.toe_x_m", "8"}}),
              ElementsAre(HasSubstr("m deep in the pile, which throws rock out")));
  EXPECT_THAT(warnings_of(checkout, {{"pile.toe_x_m", "8"}, {"pile.clear_machine", "on"}}),
              ElementsAre());
  EXPECT_THAT(warnings_of(checkout, {{"truck.position_m", "[16, 0, 0]"}}),
              testing::Contains(HasSubstr("so its bed counts rock")));
}

TEST(Warnings, TruckThatIsHitOrMissed) {
  const Checkout checkout(true);
  EXPECT_THAT(warnings_of(checkout, {{"truck.position_m", "[3.3, 18.6, 7]"}}),
              testing::UnorderedElementsAre(
                  HasSubstr("the dipper passes through the truck, "),
                  HasSubstr("the truck's lowest point is at z = 7.8 m, and the ground at 0")));
  EXPECT_THAT(warnings_of(checkout, {{"truck.position_m", "[3.3, -18.6, 0]"}}),
              ElementsAre(HasSubstr("no truck is under the dipper")));
}

TEST(Warnings, NumbersInAnotherUnit) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"machine.rake_angle_deg", "1.0786"}}),
              testing::Contains(HasSubstr("is the value in rad? write 61.8")));
  EXPECT_THAT(warnings_of(checkout, {{"coupling.sync_steps", "200"}}),
              ElementsAre(HasSubstr("which takes at most 33 steps")));
  EXPECT_THAT(warnings_of(checkout, {{"pile.width_m", "4"}}),
              ElementsAre(HasSubstr("narrower than the dipper")));
  EXPECT_THAT(warnings_of(checkout, {}, false),
              ElementsAre(HasSubstr("a third of the dipper's mouth")));
}

/// With the first `from` of a file of the checkout, its machine or its motion, replaced by `to`.
std::vector<std::string> with_text(const std::string& file, const std::string& from,
                                   const std::string& to) {
  const Checkout checkout;
  std::string text = test::read_text(checkout.root / file);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  test::write_text(checkout.root / file, text.replace(at, from.size(), to));
  return warnings_of(checkout);
}

/// Warnings of `quick` with a sieve curve in place of its classes.
std::vector<std::string> with_sieve(const std::string& rows, const std::string& sizes = "") {
  const Checkout checkout;
  const std::string text = test::read_text(checkout.file());
  test::write_text(checkout.file(), text.substr(0, text.find("  classes:")) +
                                        "  sieve: {file: sieve.csv, classes: 3" +
                                        (sizes.empty() ? "" : ", " + sizes) + "}\n" +
                                        text.substr(text.find("contact:")));
  test::write_text(checkout.folder() / "sieve.csv", "size_m,passing_percent\n" + rows);
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  test::expect_findings(findings, {});
  return messages(c);
}

TEST(Warnings, ASieveCurveThatEndsBelowAll) {
  EXPECT_THAT(with_sieve("0.15,0\n0.25,40\n0.6,60\n"),
              testing::Contains(
                  HasSubstr("rock.sieve.file: the curve ends at 60 %, at 0.6 m: the 40 % of")));
  EXPECT_THAT(with_sieve("0.15,0\n0.25,40\n0.6,97\n"),
              testing::Not(testing::Contains(HasSubstr("the curve ends"))));
}

TEST(Warnings, ASieveCurveOfWhichMostIsCutOff) {
  EXPECT_THAT(with_sieve("0.15,0\n0.25,40\n0.6,100\n", "min_size_m: 0.4"),
              testing::Contains(HasSubstr("rock.sieve.min_size_m: 72 % of the rock's mass are")));
  EXPECT_THAT(with_sieve("0.15,0\n0.25,40\n0.6,100\n", "min_size_m: 0.25"),
              testing::Not(testing::Contains(HasSubstr("of the rock's mass are"))));
}

TEST(Warnings, ASieveCurveWithOneShareThatMayBeOf1) {
  EXPECT_THAT(with_sieve("0.15,0\n0.25,0.4\n0.6,100\n"),
              testing::Contains(HasSubstr(
                  "jumps from 0.4 at 0.25 m, line 3, to 100 at 0.6 m: is the 0.4 a share of 1?")));
  EXPECT_THAT(with_sieve("0.15,0\n0.25,0.4\n0.4,30\n0.6,100\n"),
              testing::Not(testing::Contains(HasSubstr("a share of 1?"))));
}

TEST(Warnings, AProfileThatNoRockHas) {
  const Checkout checkout;
  const auto with = [&](const decltype(cases::PileCase::outline_m)& outline) {
    std::vector<Finding> findings;
    cases::Case c = cases::load_case(checkout.folder(), {}, findings);
    c.pile.profile = checkout.folder() / "profile.csv";
    c.pile.outline_m = outline;
    return messages(c);
  };
  EXPECT_THAT(with({{14, 0}, {16, 2}, {18, 5}, {20, 8}, {30, 8}}),
              testing::Not(testing::Contains(HasSubstr("pile.profile"))));
  EXPECT_THAT(with({{14, 0}, {14.5, 2}, {15, 5}, {16, 8}, {30, 8}}),
              testing::Contains(HasSubstr("pile.profile: the face stands at 76 degrees")));
  EXPECT_THAT(with({{14, 4}, {18, 8}, {30, 8}}),
              testing::Contains(HasSubstr("pile.profile: begins with a step of 4 m at the toe")));
  EXPECT_THAT(with({{14, 0}, {16, 2}, {18, 5}, {19, 0}, {20, 7}, {22, 8}, {30, 8}}),
              testing::Contains(HasSubstr("pile.profile: the point at x = 19 m is at 0 m, those "
                                          "beside it at 5 to 7 m: is it a wrong reading, or no")));
  EXPECT_THAT(with({{14, 0}, {16, 2}, {18, 5}, {19, 45}, {20, 7}, {22, 8}, {30, 8}}),
              testing::Contains(HasSubstr("x = 19 m is at 45 m, those beside it at 5 to 7 m")));
  EXPECT_THAT(with({{14, 0}, {18, 4}, {22, 1}, {26, 5}, {30, 8}}),
              testing::Not(testing::Contains(HasSubstr("those beside it"))))
      << "a valley";
}

TEST(Warnings, ASurfaceWithALonePoint) {
  const Checkout checkout;
  const auto with = [&](double z_m) {
    mesh::TriangleMesh fan;  // a slope around one point
    const auto at = [](double x, double y) { return Vector3d(x, y, x - 14); };
    const std::vector<Vector3d> rim = {at(14, -6), at(26, -6), at(26, 6), at(14, 6)};
    const Vector3d middle(20, 0, z_m);
    fan.vertices = {middle};
    for (const double r : {1.0, 6.0})
      for (const Vector3d& p : rim)
        fan.vertices.push_back(at(20 + (p.x() - 20) * r / 6, p.y() * r / 6));
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t a = 1 + k, b = 1 + (k + 1) % 4;
      fan.triangles.push_back({0, a, b});
      fan.triangles.push_back({a, a + 4, b + 4});
      fan.triangles.push_back({a, b + 4, b});
    }
    std::vector<Finding> findings;
    cases::Case c = cases::load_case(checkout.folder(), {}, findings);
    c.pile.profile = checkout.folder() / "face.stl";
    c.pile.surface = std::make_shared<cases::BenchSurface>(fan);
    c.pile.outline_m = c.pile.surface->section(c.pile.width_m / 2, 1);
    return messages(c);
  };
  EXPECT_THAT(with(0), testing::Contains(HasSubstr("x = 20, y = 0 m is at 0 m, those beside it at "
                                                   "5 to 7 m: is it a wrong reading, or no data")));
  EXPECT_THAT(with(6), testing::Not(testing::Contains(HasSubstr("those beside it"))));
}

TEST(Warnings, ACrustAboveAllRock) {
  const Checkout checkout;
  const auto with_crust = [&](const char* above_m) {
    return warnings_of(checkout, {{"crust.tensile_strength_Pa", "2e5"},
                                  {"dem.hold_below_m_s", "0"},
                                  {"crust.above_m", above_m}});
  };
  EXPECT_THAT(with_crust("4"), ElementsAre());
  EXPECT_THAT(with_crust("40"),
              ElementsAre(HasSubstr("crust.above_m: is 40 m, not below the top")));
}

TEST(Warnings, KeysThatNothingReads) {
  const auto of = [](const std::vector<cases::Override>& set) {
    return messages_of("cases/aitik", set);
  };
  const auto before = of({});
  EXPECT_THAT(of({{"operator.passes", "3"}, {"collapse.at_s", "20"}}),
              testing::IsSupersetOf({HasSubstr("operator.passes: has no effect with machine."),
                                     HasSubstr("collapse.at_s: has no effect with collapse.he")}));
  EXPECT_EQ(of({{"operator.passes", "3"}}).size(), before.size() + 1);
}

TEST(Warnings, AMotionThatAnOperatorWhoPlansDoesNotFollow) {
  const auto unused = testing::Contains(
      HasSubstr("machine.operator: plan: of machine.motion, which has 3 dumps, only the start"));
  const std::string motion = (test::source() / "cases/screening/motion.csv").string();
  const std::string plan = (test::source() / "cases/quick/plan.yaml").string();
  EXPECT_THAT(messages_of("cases/quick", {{"machine.motion", motion}}), unused);
  EXPECT_THAT(messages_of("cases/quick", {}), testing::Not(unused));
  EXPECT_THAT(
      messages_of("cases/screening", {{"machine.operator", "plan"}, {"machine.plan", plan}}),
      testing::Not(unused));
}

TEST(Warnings, TimesAndLoadsInAnotherUnit) {
  const auto of = [](const std::vector<cases::Override>& set) {
    return messages_of("cases/screening", set);
  };
  const auto says = [](const char* what) { return testing::Contains(HasSubstr(what)); };
  EXPECT_THAT(of({{"truck.rated_t", "480"}}),
              says("truck.rated_t: 480 t is more than the largest"));
  EXPECT_THAT(of({{"pile.settle_s", "1000"}}),
              says("pile.settle_s: 1000 s, and poured rock comes"));
  EXPECT_THAT(of({{"output.dump_every_s", "250"}}),
              says("output.dump_every_s: 250 s is longer than the run, 102 s: the report has one"));
  EXPECT_THAT(of({{"truck.rated_t", "220"}}), ElementsAre());
}

TEST(Warnings, APassOfMinutes) {
  const Checkout checkout;
  test::write_text(checkout.folder() / "slow.csv",
                   "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,-8,0,0,0\n1000,-8,0,0,0\n"
                   "1010,-8,0,0,75\n1020,-8,0,0,0\n");
  std::vector<Finding> findings;
  const cases::Case c =
      cases::load_case(checkout.folder(),
                       {{"machine.motion", (checkout.folder() / "slow.csv").string()},
                        {"machine.operator", "motion"}},
                       findings);
  EXPECT_THAT(messages(c), testing::Contains(HasSubstr("the first pass ends at 100")));
}

TEST(Warnings, KeysThatWereTurnedOff) {
  const auto unused = testing::Contains(HasSubstr("has no effect"));
  EXPECT_THAT(messages_of("studies/prescribed", {}),
              testing::Not(unused));  // cases/quick has the passes
  EXPECT_THAT(messages_of("cases/quick", {{"machine.operator", "motion"}}), testing::Not(unused));
  EXPECT_THAT(messages_of("studies/prescribed", {{"operator.passes", "2"}}), unused);
}

TEST(Warnings, DensitiesInAnotherUnit) {
  const auto of = [](const std::vector<cases::Override>& set) {
    return messages_of("cases/quick", set);
  };
  EXPECT_THAT(of({{"rock.bulk_density_kg_m3", "400"}}),
              testing::Contains(HasSubstr("400 kg/m3 leaves 89 % voids")));
  EXPECT_THAT(of({{"rock.density_kg_m3", "234"}, {"rock.bulk_density_kg_m3", "131"}}),
              testing::Contains(HasSubstr("234 kg/m3 is lighter than water")));
  EXPECT_THAT(of({}), testing::Not(testing::Contains(HasSubstr("voids"))));
}

TEST(Warnings, AShovelBesideTheBench) {
  std::vector<Finding> findings;
  EXPECT_THAT(messages(cases::load_case(test::source() / "cases/quick",
                                        {{"machine.base_position_m", "[0, -14, 0]"}}, findings),
                       true),
              testing::Contains(HasSubstr("pass 1 cannot fill the dipper")));
}

TEST(Warnings, QuaternionsWithTheScalarLast) {
  const std::filesystem::path table = std::filesystem::path(testing::TempDir()) / "scalar_last.csv";
  const auto with = [&](const std::string& last) {
    test::write_text(table,
                     "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz\n0,bucket,1.5,0,0.3,0,0,0,1\n"
                     "1,bucket,1.6,0,0.3,0,0,0,1\n2,bucket,1.7,0,0.3,0,0.6,0,0.8\n"
                     "3,bucket,1.8,0,0.3,0,0.6,0,0.8\n" +
                         last);
    std::vector<Finding> findings;
    return messages(cases::load_case(test::source() / "cases/loader",
                                     {{"machine.poses", table.string()}}, findings));
  };
  EXPECT_THAT(with("4,bucket,1.9,0,0.3,0,0.8,0,0.6\n"),  // tilted beyond 90 degrees
              testing::Contains(HasSubstr("in 4 of 5 rows, so that x points back: is the scalar")));
  EXPECT_THAT(with("4,bucket,1.9,0,0.3,0,0.8,0,0.6\n5,bucket,2,0,0.3,0,0.8,0,0.6\n"),
              testing::Not(testing::Contains(HasSubstr("scalar last"))));
}

TEST(Warnings, BodiesOfAPoseTable) {
  const std::filesystem::path folder = test::source() / "cases/loader";
  const std::filesystem::path table =
      std::filesystem::path(testing::TempDir()) / "bodies_of_poses.csv";
  const auto with = [&](const std::string& rows) {
    test::write_text(table, "time_s,body,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows);
    std::vector<Finding> findings;
    return messages(cases::load_case(folder, {{"machine.poses", table.string()}}, findings));
  };
  EXPECT_THAT(with("0,bucket,1.5,0,0.3,1,0,0,0\n1,bucket,1.5,0,0.12,1,0,0,0\n"), ElementsAre());
  EXPECT_THAT(with("0,bucket,1.5,0,0.3,1,0,0,0\n1,bucket,1.5,0,0.3,1,0,0,0\n"),
              ElementsAre(HasSubstr("bucket never moves")));
  EXPECT_THAT(with("0,bucket,1.5,0,0.3,1,0,0,0\n1,bucket,1.5,0,-0.8,1,0,0,0\n"),
              ElementsAre(HasSubstr("bucket goes 0.")));
}

TEST(Warnings, CavityOfAPosedBody) {
  const std::filesystem::path bucket = std::filesystem::path(testing::TempDir()) / "bucket.stl";
  std::filesystem::copy_file(test::source() / "meshes/bucket.stl", bucket,
                             std::filesystem::copy_options::overwrite_existing);
  const auto with_cavity = [&](const std::string& cavity) {
    test::write_text(std::filesystem::path(bucket).replace_extension(".yaml"),
                     "struck_volume_m3: 1\nheap_height_m: 0.1\ncavity: " + cavity + "\n");
    std::vector<Finding> findings;
    return messages(cases::load_case(test::source() / "cases/loader",
                                     {{"bodies.bucket", bucket.string()}}, findings));
  };
  EXPECT_THAT(with_cavity("{min_m: [0.1, -0.5, 0.1], max_m: [0.6, 0.5, 0.6]}"), ElementsAre());
  EXPECT_THAT(with_cavity("{min_m: [0.1, -9, 0.1], max_m: [0.6, 9, 0.6]}"),
              ElementsAre(HasSubstr("m beyond the mesh: rock beside the bucket")));
}

TEST(Warnings, MassesThatNoBodyHas) {
  const std::string machine = "mbs/bucyrus495.yaml";
  EXPECT_THAT(with_text(machine, "mass: {value: 42000.0", "mass: {value: 42"),  // t
              ElementsAre(HasSubstr("dipper.mass: 42 kg and an inertia of")));
  EXPECT_THAT(with_text(machine, "swing_inertia: {value: 6.0e7", "swing_inertia: {value: 6.0e4"),
              ElementsAre(HasSubstr("house.swing_inertia: 900000 kg and an inertia of 60000")));
}

TEST(Warnings, InsideOfAnotherDipper) {
  EXPECT_THAT(with_text("mbs/bucyrus495.yaml", "[4.0, 4.0, 3.0]", "[4.0, 3.0, 3.0]"),
              ElementsAre(HasSubstr("dipper.inside: is 4 x 3 x 3 m, but the cavity in the YAML")));
}

TEST(Warnings, AHandleWithItsMassOutsideIt) {
  const std::string machine = "mbs/bucyrus495.yaml", given = "mass_center: {value: -5.0";
  EXPECT_THAT(
      with_text(machine, given, "mass_center: {value: 5.0"),
      ElementsAre(HasSubstr("handle.mass_center: 5 m is in front of the handle, some 10.9")));
  EXPECT_THAT(with_text(machine, given, "mass_center: {value: -50"),
              ElementsAre(HasSubstr("handle.mass_center: -50 m is behind the handle")));
}

TEST(Warnings, RopesThatDoNotHoldTheDipper) {
  EXPECT_THAT(
      with_text("mbs/bucyrus495.yaml", "axial_stiffness: {value: 2.5e8",
                "axial_stiffness: {value: 2.5e5"),
      ElementsAre(HasSubstr("rope.axial_stiffness: 2.5e+05 N let the ropes stretch by 5.")));
}

TEST(Warnings, DrivesAndLoadsInAnotherUnit) {
  const std::string machine = "mbs/bucyrus495.yaml";
  EXPECT_THAT(with_text(machine, "hoist_stall: {value: 4.8e6", "hoist_stall: {value: 4800"),
              testing::Contains(HasSubstr("4.8e+03 N do not lift the empty dipper")));
  EXPECT_THAT(with_text(machine, "hoist_power: {value: 3.0e6", "hoist_power: {value: 3000"),
              ElementsAre(HasSubstr("drives.hoist_power: 3000 and a stall of 4.8e+06 give full")));
  EXPECT_THAT(with_text(machine, "rated_load: {value: 1.09e5", "rated_load: {value: 109"),
              ElementsAre(HasSubstr("dipper.rated_load: 109 kg, but the dipper full of")));
}

TEST(Warnings, AnglesOfTruckAndDipper) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"truck.heading_deg", "2.967"}}),
              ElementsAre(HasSubstr("is the value in rad? write 170")));
  EXPECT_THAT(warnings_of(checkout, {{"truck.heading_deg", "3"}}), ElementsAre());
}

TEST(Warnings, MotionThatTurnsTooFar) {
  const Checkout checkout;
  test::write_text(checkout.folder() / "motion.csv",
                   "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,-4,0.5,0,0\n10,-4,0.5,150,0\n"
                   "30,-4,0.5,370,0\n");
  std::vector<Finding> loaded;
  EXPECT_THAT(messages(cases::load_case(checkout.folder(), {}, loaded)),
              testing::Contains(HasSubstr("swing_deg: reaches 370 degrees, more than")));
}

TEST(Warnings, DrivesThatCannotMoveAndRopesThatDoNotHold) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"machine.crowd_friction_N", "1e8"}}),
              ElementsAre(HasSubstr("are more than the crowd's stall force")));
  EXPECT_THAT(warnings_of(checkout, {{"machine.rope_compliance", "100"}}),
              ElementsAre(HasSubstr("machine.rope_compliance: with 100 times the stretch")));
}

TEST(Warnings, APileThatCannotMoveOrHasNotSettled) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"pile.held_layer_m", "10"}}),
              testing::Contains(HasSubstr("pile.held_layer_m: 10 m hold all rock of a bench")));
  EXPECT_THAT(warnings_of(checkout, {{"pile.settle_s", "0"}, {"pile.relax_s", "0"}}),
              testing::Contains(HasSubstr("pile.settle_s: with pile.relax_s 0")));
}

TEST(Warnings, ALoggerTooSlowForAPass) {
  EXPECT_THAT(warnings_of(Checkout(true), {{"observation.rate_Hz", "0.05"}}),
              testing::Contains(HasSubstr("observation.rate_Hz: 0.05 Hz is a reading every 20 s")));
}

TEST(Warnings, SettingsFarFromWhatTheyAreFor) {
  const Checkout checkout;
  const auto of = [&](const std::string& key, const std::string& value) {
    return warnings_of(checkout, {{key, value}});
  };
  EXPECT_THAT(of("rock.bulk_density_kg_m3", "3200"),
              testing::Contains(HasSubstr("is it the density of solid rock?")));
  EXPECT_THAT(of("truck.rated_t", "0.22"),
              testing::Contains(HasSubstr("truck.rated_t: 0.22 t is less than half")));
  EXPECT_THAT(of("output.checkpoint_every_s", "0.01"),
              testing::Contains(HasSubstr("output.checkpoint_every_s: 0.01 s are")));
  EXPECT_THAT(of("end_s", "100"), testing::Contains(HasSubstr("the machine stands still after")));
  std::vector<Finding> findings;
  EXPECT_THAT(messages(cases::load_case(test::source() / "cases/quick",
                                        {{"operator.scan_error_m", "5"}}, findings)),
              testing::Contains(HasSubstr("operator.scan_error_m: with an error of 5 m")));
}

TEST(Warnings, LayersThinnerThanARockAndKeysThatDoNothing) {
  const auto of = [](const std::string& name, const std::vector<cases::Override>& set) {
    std::vector<Finding> findings;
    const cases::Case c = cases::load_case(test::source() / "cases" / name, set, findings);
    test::expect_findings(findings, {});
    return messages(c);
  };
  const auto says = [](const char* what) { return testing::Contains(HasSubstr(what)); };
  EXPECT_THAT(of("quick", {{"pile.settle_s", "0.25"}}), says("the poured rock has not come down"));
  EXPECT_THAT(of("quick", {{"pile.held_layer_m", "0.1"}}), says("0.1 m hold no rock"));
  EXPECT_THAT(of("screening", {{"pile.clean_floor_to_x_m", "30"}}),
              says("pile.clean_floor_to_x_m: at 30 m the bench is"));
  const std::vector<cases::Override> crust = {{"crust.above_m", "3"}, {"crust.thickness_m", "0.1"}};
  EXPECT_THAT(of("quick", crust), says("has no effect with crust.tensile_strength_Pa: 0"));
  std::vector<cases::Override> thin = crust;
  thin.push_back({"crust.tensile_strength_Pa", "1e5"});
  thin.push_back({"dem.hold_below_m_s", "0"});
  EXPECT_THAT(of("quick", thin), says("crust.thickness_m: 0.1 m bond no rocks"));
  EXPECT_THAT(of("quick", {{"rock.coarse_graining_limit_m", "0.085"}}),
              says("rock.coarse_graining: has no effect with rock.coarse_graining_limit_m: 0.085"));
  EXPECT_THAT(of("quick", {{"seed", "800001"}}), says("800001 gives the same pile as seed 1"));
  EXPECT_THAT(of("quick", {{"collapse.height_m", "2"}, {"collapse.at_s", "20"}}),
              says("where the dipper is at 20 s depends on how the dig goes"));
}

TEST(Warnings, ContactsSoSoftThatRocksOverlap) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"contact.normal_scale", "1e-4"}}),
              testing::Contains(HasSubstr("contact.normal_scale: under the weight of the bench")));
}

TEST(Warnings, ARunThatEndsBeforeItsFirstDumpOrItsCollapse) {
  const auto coarse = [](const std::vector<cases::Override>& set) {
    std::vector<Finding> findings;
    const cases::Case c = cases::load_case(test::source() / "cases/aitik_coarse", set, findings);
    test::expect_findings(findings, {});
    return messages(c, true);
  };
  const auto too_soon = testing::Contains(HasSubstr("end_s: the run ends at"));
  EXPECT_THAT(coarse({{"end_s", "12"}}), too_soon);
  EXPECT_THAT(coarse({{"end_s", "40"}}), testing::Not(too_soon));
  const auto not_in_the_run =
      testing::Contains(HasSubstr("collapse.at_s: has no effect with end_s: 40; the slab"));
  EXPECT_THAT(coarse({{"end_s", "40"}, {"collapse.height_m", "1"}, {"collapse.at_s", "41"}}),
              not_in_the_run);
  EXPECT_THAT(coarse({{"end_s", "40"}, {"collapse.height_m", "1"}, {"collapse.at_s", "30"}}),
              testing::Not(not_in_the_run));
  const Checkout first_rows;
  std::vector<Finding> findings;
  EXPECT_THAT(messages(cases::load_case(first_rows.folder(), {}, findings), true),
              testing::Contains(HasSubstr("door_deg: never opens after the start")));
}

TEST(Warnings, AFaceSteeperThanRockRests) {
  const Checkout checkout;
  EXPECT_THAT(warnings_of(checkout, {{"pile.face_angle_deg", "89"}}),
              testing::Contains(HasSubstr("pile.face_angle_deg: the face stands at 89 degrees")));
  test::write_text(checkout.folder() / "wall.csv", "x_m,z_m\n13,0\n13.001,8\n20,8\n");
  std::vector<Finding> loaded;
  EXPECT_THAT(messages(cases::load_case(checkout.folder(), {{"pile.profile", "wall.csv"}}, loaded)),
              testing::Contains(HasSubstr("pile.profile: the face stands at 90 degrees")));
}

TEST(Warnings, MotionWithAHole) {
  const Checkout checkout;
  test::write_text(checkout.folder() / "motion.csv",
                   "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,-4,0.5,0,0\n1,-4,0.5,0,0\n"
                   "9,-6,0.5,0,0\n");
  EXPECT_THAT(warnings_of(checkout),
              testing::Contains(HasSubstr("no row between 1.00 and 9.00 s")));
}

TEST(Warnings, SwingThatIsNotOverWhereRockIsFeltAgain) {
  const Checkout checkout;
  // The crowd is all in from 18 to 20 s.
  const auto returns = [&](const std::string& at_18_s, const std::string& at_20_s) {
    test::write_text(checkout.folder() / "motion.csv",
                     "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,-4,0.5,0,0\n2,-4,1.2,0,0\n"
                     "8,-6,0.5,40,0\n10,-6,0.5,40,70\n12,-6,0.4,40,0\n18,-4,-0.5," +
                         at_18_s + ",0\n20,-4,-0.5," + at_20_s +
                         ",0\n24,-4,1.2,0,0\n30,-6,0.5,40,0\n32,-6,0.5,40,70\n");
    return warnings_of(checkout, {{"machine.contact_on_return", "off"}});
  };
  EXPECT_THAT(returns("20", "12"), testing::Contains(HasSubstr("the house still turns")));
  EXPECT_THAT(returns("0", "0"), testing::Not(testing::Contains(HasSubstr("still turns"))));
  EXPECT_THAT(warnings_of(checkout), testing::Not(testing::Contains(HasSubstr("still turns"))));
}

TEST(Warnings, HeelThatClosesOnTheGround) {
  const Checkout checkout;
  const machine::ShovelKinematics shovel(
      machine::load_machine(checkout.root / "mbs/bucyrus495.yaml"), Pose{}, radians(61.8));
  const auto out_at = [&](double rise) {
    std::string rows = "time_s,hoist_m,crowd_m,swing_deg,door_deg\n";
    for (int k = 0; k <= 12; ++k) {
      const double x = 14.4 + 0.4 * k;
      const machine::Drives d = shovel.teeth_at({x, 1.0 + rise * (x - 14.4)});
      rows += fmt::format("{},{},{},0,0\n", k, d.hoist, d.crowd);
    }
    test::write_text(checkout.folder() / "motion.csv", rows);
    return warnings_of(checkout);
  };
  EXPECT_THAT(out_at(0),
              testing::Contains(HasSubstr("the dipper closes on the ground: at 12.0 s")));
  EXPECT_THAT(out_at(0.3), testing::Not(testing::Contains(HasSubstr("closes on"))));
}

TEST(Warnings, MeshesThatLookWrong) {
  EXPECT_THAT(with_dipper([](const Vector3d& v) { return Vector3d(1000 * v); }),
              testing::Contains(HasSubstr("in mm? scale it by 0.001")));
  EXPECT_THAT(with_dipper([](const Vector3d& v) { return Vector3d(v / 0.3048); }),
              testing::Contains(HasSubstr("is it in ft? scale it by 0.305")));
  EXPECT_THAT(with_dipper([](const Vector3d& v) { return Vector3d(v.x(), -v.z(), v.y()); }),
              testing::Contains(HasSubstr("is its y up?")));
  EXPECT_THAT(with_dipper([](const Vector3d& v) { return Vector3d(v.x() + 1, v.y(), v.z()); }),
              testing::Contains(HasSubstr("docs/frames.md")));
}

TEST(Warnings, WhatTheMeshHoldsAgainstWhatIsSaidOfIt) {
  const auto as_it_is = [](const Vector3d& v) { return v; };
  EXPECT_THAT(with_dipper(as_it_is), ElementsAre());
  EXPECT_THAT(with_dipper([](const Vector3d& v) { return Vector3d(v.x(), 0.75 * v.y(), v.z()); }),
              testing::Contains(HasSubstr("struck, but its YAML says struck_volume_m3: 42")));
  const std::string shape = "heap_height_m: 1.0\ncavity: {min_m: [0, -2, -1.5], max_m: ";
  EXPECT_THAT(
      with_dipper(as_it_is, "struck_volume_m3: 20\n" + shape + "[4, 2, 1.5]}\n"),
      testing::IsSupersetOf({HasSubstr("struck_volume_m3: 20"),
                             HasSubstr("is 42 m3, but the YAML of the dipper's mesh says 20")}));
  EXPECT_THAT(with_dipper(as_it_is, "struck_volume_m3: 42\n" + shape + "[4, 3.5, 1.5]}\n"),
              testing::Contains(HasSubstr("m beyond the mesh: rock beside the dipper")));
}

}  // namespace
}  // namespace dipper::check
