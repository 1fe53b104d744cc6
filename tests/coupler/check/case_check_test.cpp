#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/case_lines.hpp"
#include "common/mesh/stl.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/check/check.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/deck/stable_timestep.hpp"
#include "tests/common/memory_reporter.hpp"
#include "tests/coupler/case/checkout.hpp"
#include "tests/coupler/deck/height_field.hpp"
#include "tests/places.hpp"

namespace dipper::check {
namespace {

using test::Checkout;
using test::expect_findings;
using test::read_text;
using test::write_text;
using testing::HasSubstr;
using testing::MatchesRegex;
namespace fs = std::filesystem;

std::vector<Finding> check(const Checkout& checkout, const std::vector<cases::Override>& set = {}) {
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), set, findings);
  expect_findings(findings, {});
  return check::check_case(c);
}

std::vector<Finding> load_findings(const Checkout& checkout) {
  std::vector<Finding> findings;
  cases::load_case(checkout.folder(), {}, findings);
  return findings;
}

TEST(CheckCase, QuickIsSound) {
  const Checkout checkout(true);
  expect_findings(check(checkout), {});
}

TEST(CheckCase, TheRepositorysQuickIsSound) {
  std::vector<Finding> findings;
  read_case(test::source() / "cases/quick", {}, findings);
  expect_findings(findings, {});
}

TEST(CheckCase, JsonHasWhatAProgramAsks) {
  Checkout checkout;
  test::MemoryReporter sound;
  EXPECT_TRUE(check::check_as_json(checkout.folder(), {{"title", "'a \"b\"'"}}, "5eed", sound));
  const auto said = nlohmann::json::parse(sound.lines);
  EXPECT_EQ(said.at("case"), "quick");
  EXPECT_EQ(said.at("source_hash"), "5eed");
  EXPECT_TRUE(said.at("sound"));
  EXPECT_TRUE(said.at("findings").empty());
  EXPECT_EQ(said.at("values").at("rock.density_kg_m3"), 3215);
  EXPECT_EQ(said.at("values").at("domain.max_m").size(), 3U);
  EXPECT_EQ(said.at("values").at("title"), "a \"b\"");
  EXPECT_GT(said.at("size").at("rocks"), 0);
  EXPECT_GT(said.at("size").at("steps"), 0);
  std::vector<Finding> findings;
  EXPECT_EQ(said.at("case_hash"), cases::case_hash(cases::load_case(
                                      checkout.folder(), {{"title", "'a \"b\"'"}}, findings)));

  const int line = checkout.replace("density_kg_m3", "density_kg_m3: heavy");
  test::MemoryReporter wrong;
  EXPECT_FALSE(check::check_as_json(checkout.folder(), {}, "5eed", wrong));
  const auto faults = nlohmann::json::parse(wrong.lines);
  EXPECT_FALSE(faults.at("sound"));
  ASSERT_EQ(faults.at("findings").size(), 1U);
  EXPECT_EQ(faults.at("findings").at(0).at("line"), line);
  EXPECT_EQ(faults.at("findings").at(0).at("key"), "rock.density_kg_m3");
  EXPECT_EQ(faults.count("case_hash"), 0U);
}

TEST(CheckCase, WhatGoesByTheMotionsTimesNeedsPrescribedDrives) {
  const Checkout checkout(true);
  const auto findings_with = [&](std::vector<cases::Override> set) {
    set.push_back({"machine.drives", "limited"});
    std::vector<Finding> findings;
    const cases::Case c = cases::load_case(checkout.folder(), set, findings);
    return findings.empty() ? check::check_case(c) : findings;
  };
  EXPECT_TRUE(findings_with({}).empty());
  EXPECT_TRUE(findings_with({{"machine.contact_on_return", "off"}}).empty()) << "the operator's";
  const auto collapse = findings_with({{"collapse.height_m", "2"}});
  ASSERT_EQ(collapse.size(), 1U);
  EXPECT_EQ(collapse[0].key, "collapse.at_s");
}

TEST(CheckCase, AnOperatorWhoPlansKeepsNoTimesOfTheMotion) {
  const auto findings_with = [](std::vector<cases::Override> set) {
    set.insert(set.end(), {{"machine.drives", "prescribed"}, {"collapse.height_m", "1"}});
    std::vector<Finding> findings;
    check::read_case(test::source() / "cases/quick", set, findings);
    return findings;
  };
  const auto unsaid = findings_with({});
  ASSERT_EQ(unsaid.size(), 1U);
  EXPECT_EQ(unsaid[0].key, "collapse.at_s");
  // The motion, of the first pass, ends at 33 s.
  EXPECT_TRUE(findings_with({{"operator.passes", "3"}, {"collapse.at_s", "60"}}).empty());
}

/// The findings with a part of a file of the checkout replaced.
std::vector<Finding> check_with(const std::string& name, const std::string& from,
                                const std::string& to) {
  const Checkout checkout;
  std::string text = read_text(checkout.root / name);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  write_text(checkout.root / name, text.replace(at, from.size(), to));
  return check(checkout);
}

TEST(CheckCase, WhatIsSaidOfAMeshFitsIt) {
  const auto said = [](const std::string& name, const std::string& from, const std::string& to) {
    std::string all;
    for (const Finding& f : check_with(name, from, to)) all += f.key + ": " + f.message + "\n";
    return all;
  };
  const std::string dipper = "meshes/dipper.yaml", truck = "meshes/truck.yaml",
                    bed = "{min_m: [-3.5, -3.25, 4.2], max_m: [3.5, 3.25, 9]}";
  EXPECT_EQ(said(dipper, "heap_height_m: 1.2", "heap_height_m: 3"), "");
  EXPECT_THAT(said(dipper, "heap_height_m: 1.2", "heap_height_m: 1200"),
              HasSubstr("heap_height_m: 1200 m, over a cavity of 4 m depth along x: in mm,"));
  EXPECT_THAT(said(dipper, "max_m: [4, 2, 1.5]", "max_m: [0.4, 2, 1.5]"),
              HasSubstr("cavity: is a box of 4.8 m3, but struck_volume_m3 is 42"));
  EXPECT_THAT(said(truck, bed, "{min_m: [100, 100, 2], max_m: [106, 106, 7]}"),
              HasSubstr("bed: from x = 100 to 106 m, but the truck's mesh has x = -"));
  for (const char* scaled : {"{min_m: [-3500, -3250, 2], max_m: [3500, 3250, 9]}",
                             "{min_m: [-0.0035, -0.00325, 4.2], max_m: [0.0035, 0.00325, 4.3]}"})
    EXPECT_THAT(said(truck, bed, scaled), HasSubstr("in another unit? write it in m"));
}

TEST(CheckCase, AMotionInHours) {
  const Checkout checkout;
  const auto with = [&](const char* rows) {
    write_text(checkout.folder() / "motion.csv",
               std::string("time_s,hoist_m,crowd_m,swing_deg,door_deg\n") + rows);
    return check(checkout);
  };
  const auto hours = with("0,-3,0.5,0,0\n0.002,-5,0.5,0,0\n0.004,-4,0.5,0,0\n");
  ASSERT_GE(hours.size(), 1U);
  EXPECT_THAT(hours[0].message, HasSubstr("the whole motion takes 0.004 s, in which the hoist "
                                          "moves 2 m: is time_s in hours or minutes?"));
}

TEST(CheckCase, AFloorIsCleanedOnAWayBackWithoutRock) {
  const Checkout checkout(true);
  const auto findings = check(checkout, {{"pile.clean_floor_to_x_m", "14.5"}});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].key, "pile.clean_floor_to_x_m");
  EXPECT_TRUE(
      check(checkout, {{"pile.clean_floor_to_x_m", "14.5"}, {"machine.contact_on_return", "off"}})
          .empty());
}

TEST(CheckCase, EveryMissingFileAtOnce) {
  const Checkout checkout;
  for (const char* file : {"meshes/dipper.stl", "meshes/door.stl", "meshes/truck.stl",
                           "mbs/bucyrus495.yaml", "cases/quick/motion.csv"}) {
    fs::remove(checkout.root / file);
  }
  fs::remove_all(checkout.root / "meshes/rocks");
  const auto file = checkout.file();
  expect_findings(
      check(checkout),
      {{file, checkout.line("dipper:"), "bodies.dipper", "no such file: "},
       {file, checkout.line("door:"), "bodies.door", "no such file: "},
       {file, checkout.line("mesh:"), "truck.mesh", "no such file: "},
       {file, checkout.line("model:"), "machine.model", "no such file: "},
       {file, checkout.line("motion:"), "machine.motion", "no such file: "},
       {file, checkout.line("shape_folder:"), "rock.shape_folder", "no such folder: "}});
}

TEST(CheckCase, MeshThatLiggghtsCannotName) {
  Checkout checkout;
  for (const char* type : {"stl", "yaml"})
    fs::rename(checkout.root / "meshes" / (std::string("truck.") + type),
               checkout.root / "meshes" / (std::string("my$truck.") + type));
  const int line = checkout.replace("mesh:", "mesh: ../../meshes/my$truck.stl");
  const fs::path truck = checkout.root / "meshes/my$truck.stl";
  expect_findings(check(checkout),
                  {{checkout.file(), line, "truck.mesh",
                    truck.string() + ": a path here takes letters, digits, blanks"}});
}

TEST(CheckCase, BrokenMeshes) {
  const Checkout checkout;
  // A closed tetrahedron inside the dipper's reach, its fourth facet missing.
  const fs::path dipper = checkout.root / "meshes/dipper.stl";
  const auto facet = [](const char* a, const char* b, const char* c) {
    return std::string("facet normal 0 0 0\nouter loop\nvertex ") + a + "\nvertex " + b +
           "\nvertex " + c + "\nendloop\nendfacet\n";
  };
  const std::string open = "solid t\n" + facet("0 0 0", "0 1 0", "1 0 0") +
                           facet("0 0 0", "1 0 0", "0 0 1") + facet("0 0 0", "0 0 1", "0 1 0");
  write_text(dipper, open + "endsolid\n");
  const fs::path door = checkout.root / "meshes/door.stl";
  std::string text = read_text(door);
  text.replace(text.find("vertex") + 7, 1, "x");
  write_text(door, text);
  const fs::path truck = checkout.root / "meshes/truck.stl";
  write_text(truck, std::string(80, ' ') + std::string("\x02\0\0\0", 4));

  int line = 1;
  for (std::size_t i = 0; i < text.find("vertex"); ++i) line += text[i] == '\n';
  expect_findings(
      check(checkout),
      {{dipper, 0, "bodies.dipper",
        "facet 1: not closed: the edge (0, 1, 0) to (1, 0, 0) has no second facet"},
       {dipper, 0, "bodies.dipper",
        "facet 2: not closed: the edge (1, 0, 0) to (0, 0, 1) has no second facet"},
       {dipper, 0, "bodies.dipper",
        "facet 3: not closed: the edge (0, 1, 0) to (0, 0, 1) has no second facet"},
       {door, line, "bodies.door", "is not a number"},
       {checkout.file(), checkout.line("mesh:"), "truck.mesh",
        truck.string() +
            ": at byte 80: the header says 2 facets, and the file has 0: it was not written"}});
}

TEST(CheckCase, NothingBesideTheMeshes) {
  const Checkout checkout;
  for (const char* mesh : {"dipper", "door", "truck"}) {  // none is needed beside the door's
    fs::remove(checkout.root / "meshes" / (std::string(mesh) + ".yaml"));
  }
  const auto file = checkout.file();
  const std::string meshes = (checkout.root / "meshes").string();
  expect_findings(
      check(checkout),
      {{file, checkout.line("dipper:"), "bodies.dipper",
        "cannot read " + meshes +
            "/dipper.yaml; write beside the mesh a file of that name with struck_volume_m3, "
            "cavity: {min_m, max_m}, heap_height_m"},
       {file, checkout.line("mesh:"), "truck.mesh",
        "cannot read " + meshes +
            "/truck.yaml; write beside the mesh a file of that name with bed: {min_m, max_m}"}});
}

TEST(CheckCase, KeysMissingBesideTheMeshes) {
  const Checkout checkout;
  const fs::path dipper = checkout.root / "meshes/dipper.yaml";
  const fs::path truck = checkout.root / "meshes/truck.yaml";
  write_text(dipper, "# ours\nunits: m\nstruck_volume: 42\ncavity:\n  min_m: [0, -2, -1.5]\n");
  write_text(truck, "");
  expect_findings(check(checkout),
                  {{dipper, 2, "struck_volume_m3", "missing key; write the volume in m3"},
                   {dipper, 4, "cavity.max_m", "missing key; write three numbers in m"},
                   {dipper, 2, "heap_height_m", "missing key; write how far in m"},
                   {truck, 1, "", "is nothing; write bed: {min_m, max_m}"}});
}

TEST(CheckCase, WrongValuesBesideTheMeshes) {
  const Checkout checkout;
  const fs::path dipper = checkout.root / "meshes/dipper.yaml";
  const fs::path truck = checkout.root / "meshes/truck.yaml";
  write_text(dipper,
             "struck_volume_m3: 0\ncavity:\n  min_m: [0, -2, deep]\n  max_m: [4, 2]\n"
             "heap_height_m: 1.2 m\n");
  write_text(truck, "bed: {min_m: [-3.5, 3.25, 4.2],\n      max_m: [3.5, -3.25, 9]}\n");
  expect_findings(check(checkout),
                  {{dipper, 1, "struck_volume_m3", "0 is out of range; allowed is > 0"},
                   {dipper, 3, "cavity.min_m.2", "is 'deep'; write three numbers in m"},
                   {dipper, 4, "cavity.max_m", "is a list; write three numbers in m"},
                   {dipper, 5, "heap_height_m", "is '1.2 m'; write how far in m"},
                   {truck, 1, "bed.min_m", "y = 3.25 is not below max_m's -3.25"}});
  write_text(dipper, "struck_volume_m3: 42\ncavity: {min_m: [0, -2\nheap_height_m: -1\n");
  write_text(truck, "bed: 5\n");
  const auto broken = check(checkout);
  ASSERT_EQ(broken.size(), 2U);
  EXPECT_EQ(broken[0].file, dipper);
  EXPECT_GT(broken[0].line, 0);
  EXPECT_THAT(broken[0].message, HasSubstr("not valid YAML: "));
  EXPECT_EQ(to_string(broken[1]), truck.string() +
                                      ":1: bed: is '5'; write {min_m, max_m}, corners of the box "
                                      "in the mesh's frame whose rock is the truck's load");
  write_text(dipper,
             "struck_volume_m3: 42\ncavity: {min_m: [0, -2, -1.5], max_m: [4, 2, 1.5]}\n"
             "heap_height_m: -1\n");
  write_text(truck, "bed: {min_m: [-3.5, -3.25, 4.2], max_m: [3.5, 3.25, 9]}\n");
  expect_findings(check(checkout),
                  {{dipper, 3, "heap_height_m", "-1 is out of range; allowed is >= 0"}});
  write_text(dipper,
             "struck_volume_m3: 42\ncavity: {min_m: [0, -2, -1.5], max_m: [4, 2, 1.5]}\n"
             "heap_height_m: 0\n");
  expect_findings(check(checkout), {});
}

TEST(CheckCase, TeethThatWearBeyondTheirLength) {
  const Checkout checkout;
  expect_findings(check(checkout, {{"machine.tooth_wear_m", "0.5"}}), {});
  expect_findings(check(checkout, {{"machine.tooth_wear_m", "0.6"}}),
                  {{"--set", 0, "machine.tooth_wear_m", "is > 0 and <= 0.54"}});
}

TEST(CheckCase, CollapseThatCannotBe) {
  const Checkout checkout(true);
  expect_findings(check(checkout, {{"collapse.height_m", "1"}}), {});
  expect_findings(check(checkout, {{"collapse.height_m", "0.001"}, {"collapse.at_s", "1e3"}}),
                  {{"--set", 0, "collapse.height_m", "less than one rock of "},
                   {"--set", 0, "collapse.at_s", "1000 s is not before the end of the motion, "}});
  expect_findings(check(checkout, {{"collapse.height_m", "8"}}),
                  {{"--set", 0, "collapse.height_m", "above domain.max_m (24 m)"}});
  expect_findings(check(checkout, {{"collapse.height_m", "1"}, {"collapse.at_s", "9"}}),
                  {{"--set", 0, "collapse.at_s", "at 9.00 s the dipper is where the slab"}});
}

TEST(CheckCase, CollapseOfAMotionThatNeverOpensTheDoor) {
  const Checkout checkout;  // its motion ends before
  expect_findings(check(checkout, {{"collapse.height_m", "1"}}),
                  {{"--set", 0, "collapse.at_s", "never opens the door; write the time"}});
}

TEST(CheckCase, InvertedTruck) {
  const Checkout checkout;
  const fs::path truck = checkout.root / "meshes/truck.stl";
  const std::string tetrahedron = [] {
    std::string text = "solid t\n";
    for (const char* f :
         {"0 0 0\nvertex 1 0 0\nvertex 0 1 0", "0 0 0\nvertex 0 0 1\nvertex 1 0 0",
          "0 0 0\nvertex 0 1 0\nvertex 0 0 1", "1 0 0\nvertex 0 0 1\nvertex 0 1 0"}) {
      text += std::string("facet normal 0 0 0\nouter loop\nvertex ") + f + "\nendloop\nendfacet\n";
    }
    return text + "endsolid\n";
  }();
  write_text(truck, tetrahedron);
  expect_findings(check(checkout), {{truck, 0, "truck.mesh",
                                     "facet 1: its shell of 4 facets faces inwards (volume "
                                     "-0.166667 m3)"}});
}

TEST(CheckCase, MotionFileWithTimeRunningBackwards) {
  const Checkout checkout;
  const fs::path motion = checkout.folder() / "motion.csv";
  write_text(motion,
             "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,0,0,0,0\n2,0,0,0,0\n1,0,0,0,0\n"
             "3,0,zero,0,0\n");
  expect_findings(check(checkout),
                  {{motion, 4, "machine.motion", "time_s is 1, not after the previous row (2 s)"},
                   {motion, 5, "machine.motion", "crowd_m is \"zero\""}});
}

TEST(CheckCase, MotionThatDoesNotBeginAtZero) {
  const Checkout checkout;
  const fs::path motion = checkout.folder() / "motion.csv";
  for (const char* first : {"-10", "4.9"}) {
    write_text(motion, std::string("time_s,hoist_m,crowd_m,swing_deg,door_deg\n") + first +
                           ",-4,0.5,0,0\n30,-4,0.5,10,0\n");
    expect_findings(check(checkout), {{motion, 0, "time_s",
                                       std::string("the first row is at ") + first +
                                           " s, and a run begins at 0 s"}});
  }
}

TEST(CheckCase, APlanThatIsNotThere) {
  Checkout checkout;
  const int line = checkout.replace("motion:", "motion: motion.csv\nplan: none.yaml");
  expect_findings(check(checkout), {{checkout.file(), line + 1, "machine.plan", "no such file: "}});
}

TEST(CheckCase, MotionBeyondRopeAndCrowd) {
  Checkout checkout;
  const fs::path motion = checkout.folder() / "motion.csv";
  write_text(motion, "time_s,hoist_m,crowd_m,swing_deg,door_deg\n0,90,0,0,0\n50,90,25,0,0\n");
  std::string all;
  for (const Finding& f : check(checkout)) {
    EXPECT_EQ(f.file, motion);
    EXPECT_EQ(f.key, "machine.motion");
    all += f.message + "\n";
  }
  EXPECT_THAT(all, HasSubstr("hoist is 90.000 m at 0.000 s, above the limit of"));
  EXPECT_THAT(all, HasSubstr("crowd is 25.000 m at 50.000 s, above the limit of"));
}

TEST(CheckCase, BrokenMachine) {
  const Checkout checkout;
  const fs::path model = checkout.root / "mbs/bucyrus495.yaml";
  write_text(model, "machine: nothing\n");
  const auto findings = check(checkout);
  ASSERT_FALSE(findings.empty());
  for (const Finding& f : findings) {
    EXPECT_EQ(f.file, model) << to_string(f);
    EXPECT_EQ(f.key, "machine.model");
    EXPECT_GT(f.line, 0) << to_string(f);
  }
}

TEST(CheckCase, MachineThatCannotClose) {
  const Checkout checkout;
  const fs::path model = checkout.root / "mbs/bucyrus495.yaml";
  std::string text = read_text(model);
  const std::string length = "length_at_zero_hoist: {value: 39.88";
  text.replace(text.find(length), length.size(), "length_at_zero_hoist: {value: 19.88");
  write_text(model, text);
  expect_findings(check(checkout),
                  {{model, 0, "machine.model", "at a crowd of -2.60 m the ropes hold the bail"}});
}

TEST(CheckCase, StepAboveTheStabilityLimit) {
  Checkout checkout;
  const int line = checkout.replace("timestep_s", "timestep_s: 1.0e-3");
  const auto findings = check(checkout);
  expect_findings(findings, {{checkout.file(), line, "dem.timestep_s",
                              "0.001 s is above the stability limit of "}});
  EXPECT_THAT(findings[0].message, MatchesRegex(".* limit of 0\\.000[0-9]+ s .*"));
}

TEST(CheckCase, StepIsChosenWhereTheCaseSaysAuto) {
  Checkout checkout;
  checkout.replace("timestep_s", "timestep_s: auto");
  std::vector<Finding> findings;
  const cases::Case c = read_case(checkout.folder(), {}, findings);
  expect_findings(findings, {});
  EXPECT_NEAR(c.dem.timestep_s / deck::stable_timestep(c), 0.85, 0.04) << "two digits";
  EXPECT_THAT(c.text,
              testing::HasSubstr(fmt::format("dem.timestep_s={:.17g}\n", c.dem.timestep_s)));
  // Stiffer rock, a shorter step.
  const cases::Case stiff =
      read_case(checkout.folder(), {{"contact.normal_scale", "0.04"}}, findings);
  EXPECT_NEAR(stiff.dem.timestep_s / c.dem.timestep_s, 0.5, 0.04);
  const int mixed = checkout.replace(
      "name: d600", "- {name: d600, size_m: 0.6, mass_percent: 44, shapes: [sphere, block]}");
  read_case(checkout.folder(), {}, findings);
  expect_findings(findings, {{checkout.file(), mixed, "rock.classes.3.shapes", "mixes spheres"}});
}

TEST(CheckCase, StepOfAFractionOfANanosecond) {
  Checkout checkout;
  const int line = checkout.replace("timestep_s", "timestep_s: 1.23456789e-4");
  expect_findings(check(checkout), {{checkout.file(), line, "dem.timestep_s",
                                     "is not a whole number of nanoseconds; write 0.000123456"}});
}

TEST(CheckCase, AMeshElsewhereIsReportedAndNothingElseOfIt) {
  const Checkout checkout;
  const mesh::TriangleMesh door = mesh::read_stl(checkout.root / "meshes/door.stl");
  const auto file = std::filesystem::path(testing::TempDir()) / "door_elsewhere.stl";
  struct Elsewhere {
    double scale;
    Eigen::Vector3d shift;
    std::string message;
  };
  for (const Elsewhere& e :
       {Elsewhere{1000, {0, 0, 0}, "and the whole domain 56 m: in mm, perhaps? An STL file has no"},
        Elsewhere{1 / 0.0254, {0, 0, 0}, "and the whole domain 56 m: in cm or inches, perhaps?"},
        Elsewhere{1, {345.2371, 210.9, 82.4}, "from its own origin, and is"}}) {
    mesh::TriangleMesh moved = door;
    for (auto& v : moved.vertices) v = e.scale * v + e.shift;
    std::ofstream(file) << mesh::to_stl("door", moved);
    expect_findings(check(checkout, {{"bodies.door", file.string()}}),
                    {{"--set", 0, "bodies.door", e.message}});
  }
}

TEST(CheckCase, ADipperInFeetIsNamedInPlaceOfWhereItLeavesTheDomain) {
  const Checkout checkout;
  mesh::TriangleMesh dipper = mesh::read_stl(checkout.root / "meshes/dipper.stl");
  const auto file = std::filesystem::path(testing::TempDir()) / "dipper_feet.stl";
  write_text(file.parent_path() / "dipper_feet.yaml",
             test::read_text(checkout.root / "meshes/dipper.yaml"));
  for (auto& v : dipper.vertices) v /= 0.3048;
  write_text(file, mesh::to_stl("dipper", dipper));
  expect_findings(check(checkout, {{"bodies.dipper", file.string()}}),
                  {{"--set", 0, "bodies.dipper", "in ft, perhaps? 15.11 ft are 4.605 m"}});
}

TEST(CheckCase, AFacetTooThinForLiggghtsIsReported) {
  Checkout checkout;
  mesh::TriangleMesh door = mesh::read_stl(checkout.root / "meshes/door.stl");
  const auto t = door.triangles[0];  // a corner close above the middle of one of its edges
  const auto& v = door.vertices;
  door.vertices.push_back((v[t[0]] + v[t[1]]) / 2 + 2e-4 * (v[t[2]] - v[t[0]]));
  const std::size_t p = door.vertices.size() - 1;
  door.triangles[0] = {t[0], t[1], p};
  door.triangles.push_back({t[1], t[2], p});
  door.triangles.push_back({t[2], t[0], p});
  const auto file = std::filesystem::path(testing::TempDir()) / "door_thin.stl";
  std::ofstream(file) << mesh::to_stl("door", door);
  expect_findings(check(checkout, {{"bodies.door", file.string()}}),
                  {{file, 0, "bodies.door", "facet 1: its smallest angle is 0.0"}});
}

TEST(CheckCase, BodiesTruckAndPileLeaveTheBox) {
  Checkout checkout(true);
  const auto file = checkout.file();
  const int top = checkout.replace("max_m", "max_m: [25, 20, 24]");
  const auto findings = check(checkout);
  expect_findings(
      findings, {{file, checkout.line("position_m"), "truck.position_m", "the truck reaches y = "},
                 {file, checkout.line("pile"), "pile", "the pile reaches x = "},
                 {file, top, "domain.max_m", "the dipper leaves the domain at "},
                 {file, top, "domain.max_m", "the door leaves the domain at "}});
  for (const Finding& f : findings) {
    EXPECT_THAT(f.message, MatchesRegex(".* reaches [xy] = [0-9.]+ m, [0-9.]+ m outside .*"));
  }
}

TEST(CheckCase, NoRoomToPour) {
  Checkout checkout;
  checkout.replace("height_m", "height_m: 15");
  expect_findings(check(checkout, {{"domain.max_m", "[45, 28, 18]"}}),
                  {{"--set", 0, "domain.max_m", "the rock for this pile is poured up to z = "}});
}

TEST(CheckCase, Shapes) {
  Checkout checkout;
  const int mixed = checkout.replace(
      "name: d300", "- {name: d300, size_m: 0.30, mass_percent: 10, shapes: [block, sphere]}");
  const int unknown = checkout.replace(
      "name: d400",
      "- name: d400\n  size_m: 0.40\n  mass_percent: 9\n  shapes:\n    - block\n    - bolder");
  write_text(checkout.root / "meshes/rocks/slab.yaml", "name: slab\n");
  // A mesh that its YAML was not made from counts in its place.
  const std::string facet =
      " facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
      "   vertex 0 1 0\n  endloop\n endfacet\n";
  write_text(checkout.root / "meshes/rocks/wedge.stl", "solid wedge\n" + facet + "endsolid\n");
  const std::string open_edge = "facet 1: not closed: the edge ";
  const fs::path wedge = checkout.root / "meshes/rocks/wedge.stl";
  std::vector<test::Expected> expected = {
      {checkout.file(), mixed, "rock.classes.1.shapes", "mixes spheres and other shapes"},
      {checkout.file(), unknown + 5, "rock.classes.2.shapes.1",
       "no shape 'bolder'; choose from blade, block, chunk, column, shard, slab, sphere, wedge"},
      {wedge, 0, "rock.shape_folder", open_edge},
      {wedge, 0, "rock.shape_folder", open_edge},
      {wedge, 0, "rock.shape_folder", open_edge}};
  for (const char* key : {"mesh_sha256", "volume", "area", "inertia", "aspect_ratio", "flatness",
                          "sphericity", "resolutions"})
    expected.push_back({checkout.root / "meshes/rocks/slab.yaml", 1, "rock.shape_folder",
                        std::string(key) + ": missing key"});
  expect_findings(check(checkout), expected);
}

TEST(CheckCase, RocksOfOneNameInTheScripts) {
  Checkout checkout;
  checkout.replace("name: d300",
                   "- {name: d300, size_m: 0.30, mass_percent: 10, shapes: [block, wedge, block]}");
  EXPECT_TRUE(fs::copy_file(checkout.root / "meshes/rocks/block.yaml",
                            checkout.root / "meshes/rocks/x_wedge.yaml"));
  const std::string mesh = read_text(checkout.root / "meshes/rocks/block.stl");
  write_text(checkout.root / "meshes/rocks/x_wedge.stl", mesh);
  checkout.replace("name: d400", "- {name: d, size_m: 0.40, mass_percent: 9, shapes: [x_wedge]}");
  const int second = checkout.replace(
      "name: d600", "- {name: d_x, size_m: 0.60, mass_percent: 44, shapes: [wedge]}");
  expect_findings(
      check(checkout),
      {{checkout.file(), checkout.line("name: d300"), "rock.classes.1.shapes.2", "stands twice"},
       {checkout.file(), second, "rock.classes.3.name",
        "shape wedge of class d_x and shape x_wedge of class d are both d_x_wedge"}});
}

/// The case's trapezoid replaced by a profile.
void use_profile(Checkout& checkout, const std::string& rows) {
  checkout.replace("toe_x_m", "profile: scan.csv");
  for (const char* key : {"height_m", "crest_depth_m", "face_angle_deg"}) checkout.replace(key, "");
  write_text(checkout.folder() / "scan.csv", "# of the face\nx_m,z_m\n" + rows);
}

TEST(CheckCase, ProfileInPlaceOfTheTrapezoid) {
  Checkout checkout;
  use_profile(checkout, "13,0\n13,2\n16,6.5\n20,6\n");
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  ASSERT_EQ(c.pile.outline_m.size(), 4U);
  EXPECT_EQ(c.pile.outline_m[2], Eigen::Vector2d(16, 6.5));
  EXPECT_NE(c.text.find("pile.profile=\"scan.csv\"\n"), std::string::npos);
  EXPECT_EQ(c.text.find("pile.height_m"), std::string::npos);  // the text is a case: one of the two
  expect_findings(check::check_case(c), {});
}

TEST(CheckCase, ProfileFaults) {
  Checkout checkout;
  use_profile(checkout, "13,0\n12,2\n16,6.5\n");
  const int line = checkout.line("profile:");
  const fs::path file = checkout.file(), scan = checkout.folder() / "scan.csv";
  const std::string at = scan.string();
  expect_findings(load_findings(checkout),
                  {{scan, 4, "pile.profile", "x_m falls from 13 to 12; points run from"}});
  write_text(scan, "x_m,z_m\n13,0\n");
  expect_findings(load_findings(checkout),
                  {{file, line, "pile.profile", at + ": 1 points; an outline has at least two"}});
  write_text(scan, "x_m,z_m\n13,0\n20,0\n");
  expect_findings(load_findings(checkout), {{file, line, "pile.profile",
                                             "no rock is under a profile of 7 m length and 0 m"}});
  fs::remove(scan);
  expect_findings(load_findings(checkout),
                  {{file, line, "pile.profile", at + ": cannot be opened"}});
}

TEST(CheckCase, ProfileThatLeavesTheDomain) {
  Checkout checkout;
  use_profile(checkout, "13,0\n16,6.5\n33,8\n60,25\n");
  const fs::path scan = checkout.folder() / "scan.csv";
  expect_findings(check(checkout, {{"domain.max_m", "[32, 28, 24]"}}),
                  {{scan, 5, "pile.profile", "x_m is 33, outside domain.max_m (32); end the"},
                   {scan, 6, "pile.profile", "z_m is 25, outside domain.max_m (24)"}});
  expect_findings(
      check(checkout, {{"domain.max_m", "[61, 28, 26]"}}),
      {{"--set", 0, "domain.max_m", "the rock for this pile is poured up to z = 55 m"}});
}

TEST(CheckCase, ProfileInAnotherUnitOrPlace) {
  Checkout checkout;
  use_profile(checkout, "13300,0\n16000,6500\n20000,6000\n");
  const fs::path scan = checkout.folder() / "scan.csv";
  expect_findings(check(checkout),
                  {{scan, 0, "pile.profile", "is 6700 m long, and the whole domain 56 m: in mm"}});
  write_text(scan, "x_m,z_m\n13300,0\n14000,1500\n15000,1500\n");
  expect_findings(check(checkout),
                  {{scan, 0, "pile.profile", "is 1700 m long, and the whole domain 56 m: in mm"}});
  for (const char* rows :
       {"512345,182.4\n512350,187\n512355,188\n", "13,182.4\n18,187\n20,188\n"}) {
    write_text(scan, std::string("x_m,z_m\n") + rows);
    expect_findings(check(checkout),
                    {{scan, 0, "pile.profile", "in the mine's coordinates, perhaps? It belongs"}});
  }
}

TEST(CheckCase, ProfileThatIsAnotherMesh) {
  Checkout checkout;
  use_profile(checkout, "");
  const fs::path scan = checkout.folder() / "scan.csv";
  for (const auto& [text, format] :
       {std::pair{"# of the drone\nmtllib a.mtl\nv 13 0 0\n", "OBJ"},
        std::pair{"ply\nformat ascii 1.0\nelement vertex 3\n", "PLY"}}) {
    write_text(scan, text);
    expect_findings(
        load_findings(checkout),
        {{checkout.file(), checkout.line("profile:"), "pile.profile",
          fmt::format("{}: begins as {}; an STL file, or a CSV x_m,z_m", scan.string(), format)}});
  }
}

TEST(CheckCase, ProfileBesideWhatItReplaces) {
  Checkout checkout;
  const int toe = checkout.replace("toe_x_m", "toe_x_m: 13\nprofile: scan.csv");
  write_text(checkout.folder() / "scan.csv", "x_m,z_m\n13,0\n16,6.5\n");
  const std::string what =
      "replaces pile.toe_x_m, pile.height_m, pile.crest_depth_m, pile.face_angle_deg";
  expect_findings(
      load_findings(checkout),
      {{checkout.file(), toe, "pile.toe_x_m", what},
       {checkout.file(), checkout.line("height_m"), "pile.height_m", what},
       {checkout.file(), checkout.line("crest_depth_m"), "pile.crest_depth_m", what},
       {checkout.file(), checkout.line("face_angle_deg"), "pile.face_angle_deg", what}});
}

/// The same by a scanned surface.
void use_surface(Checkout& checkout, const mesh::TriangleMesh& mesh) {
  use_profile(checkout, "");
  checkout.replace("profile:", "profile: scan.STL");
  write_text(checkout.folder() / "scan.STL", mesh::to_stl("scan", mesh));
}

double face(double x, double y) { return std::min(0.9 * (x - 13), 5 + 0.2 * y); }

mesh::TriangleMesh scan(double half_width) {
  return deck::height_field({13, 15, 17, 18, 19, 20, 21}, {-half_width, -1, 0, 2, half_width},
                            face);
}

TEST(CheckCase, SurfaceInPlaceOfTheTrapezoid) {
  Checkout checkout;
  use_surface(checkout, scan(6));
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  ASSERT_TRUE(c.pile.surface);
  EXPECT_NEAR(c.pile.surface->height(20, 2), 5.4, 1e-6);
  // Poured as high as the highest of it within the width.
  EXPECT_NEAR(deck::pile_shape(c).height_m, 5 + 0.2 * c.pile.width_m / 2, 1e-6);
  EXPECT_NEAR(deck::pile_shape(c).rear_x_m, 21, 1e-6);
  EXPECT_NE(c.text.find("pile.profile=\"scan.STL\"\n"), std::string::npos);
  expect_findings(check::check_case(c), {});
}

TEST(CheckCase, SurfaceThatIsNone) {
  Checkout checkout;
  use_surface(checkout, scan(6));
  const int line = checkout.line("profile:");
  const fs::path stl = checkout.folder() / "scan.STL";
  const auto expect = [&](const std::string& text, const std::string& message) {
    write_text(stl, text);
    expect_findings(load_findings(checkout),
                    {{checkout.file(), line, "pile.profile", stl.string() + message}});
  };
  write_text(stl, "x_m,z_m\n13,0\n16,6.5\n");
  expect_findings(load_findings(checkout), {{stl, 1, "pile.profile",
                                             "not an ascii STL file: 'x_m,z_m' where 'solid' "
                                             "belongs"}});
  expect("", ": holds no facets");
  expect("solid scan\nendsolid scan\n", ": holds no facets");
  expect(
      mesh::to_stl("scan", deck::height_field({13, 21}, {-6, 6}, [](double, double) { return 0; })),
      ": no rock is under a profile of 8 m length and 0 m height");
  fs::remove(stl);
  expect_findings(load_findings(checkout),
                  {{checkout.file(), line, "pile.profile", stl.string() + ": no such file"}});
}

TEST(CheckCase, SurfaceThatDoesNotFitTheBench) {
  Checkout checkout;
  use_surface(checkout, scan(3));
  const int line = checkout.line("profile:");
  const fs::path stl = checkout.folder() / "scan.STL";
  const auto expect = [&](const mesh::TriangleMesh& mesh, const fs::path& file, int at,
                          const std::string& message) {
    write_text(stl, mesh::to_stl("scan", mesh));
    expect_findings(check(checkout), {{file, at, "pile.profile", message}});
  };
  expect(scan(3), stl, 0, "leaves 24.7 % of the bench uncovered, x = 13 m, y = -4 m for one");
  expect(
      deck::height_field({13, 21}, {7, 9}, face), stl, 0,
      "leaves 100 % of the bench uncovered, x = 13 m, y = -4 m for one; it lies at y = 7 to 9 m");
  mesh::TriangleMesh mesh = scan(6);
  deck::add(mesh, deck::height_field({18, 19}, {-1, 1}, [](double, double) { return 3; }));
  expect(mesh, stl, 0, "overhangs: facets are at z = 3 m and 5.13 m at x = 18.9 m, y = 0.9 m");
  expect(deck::height_field({13, 15, 21}, {-6, 6}, [](double x, double) { return x - 14; }), stl, 0,
         "is 1 m under the ground at x = 13 m");
  expect(deck::height_field({13, 33}, {-6, 6}, face), checkout.file(), line,
         "reaches x = 33 m, 1 m outside domain.max_m (32 m)");
  write_text(stl, mesh::to_stl("scan", deck::height_field({13, 21}, {-6, 6}, [](double x, double) {
                                 return 1.5 * (x - 13);
                               })));
  expect_findings(check(checkout), {{checkout.file(), checkout.line("max_m"), "domain.max_m",
                                     "the rock for this pile is poured up to z = 26.4 m"}});
}

TEST(CheckCase, SurfaceInAnotherUnitOrPlace) {
  Checkout checkout;
  use_surface(checkout, scan(6));
  const fs::path stl = checkout.folder() / "scan.STL";
  mesh::TriangleMesh mesh = scan(6);
  for (Eigen::Vector3d& v : mesh.vertices) v *= 1000;
  write_text(stl, mesh::to_stl("scan", mesh));
  expect_findings(check(checkout), {{stl, 0, "pile.profile",
                                     "m long, and the whole domain 56 m: in "
                                     "mm, perhaps?"}});
  mesh = scan(6);
  for (Eigen::Vector3d& v : mesh.vertices) v += Eigen::Vector3d(512.37, 744.31, 182);
  write_text(stl, mesh::to_stl("scan", mesh));
  expect_findings(check(checkout),
                  {{stl, 0, "pile.profile", "in the mine's coordinates, perhaps?"}});
}

TEST(CheckCase, SurfaceBesideWhatItReplaces) {
  Checkout checkout;
  use_surface(checkout, scan(6));
  checkout.replace("profile:", "profile: scan.STL\ntoe_x_m: 13");
  expect_findings(load_findings(checkout),
                  {{checkout.file(), checkout.line("toe_x_m"), "pile.toe_x_m",
                    "pile.profile is given as well and replaces pile.toe_x_m"}});
}

TEST(CheckCase, HeldLayerInACrust) {
  Checkout checkout;
  const int line = checkout.replace("toe_x_m", "toe_x_m: 13\nheld_layer_m: 0.5") + 1;
  std::vector<Finding> findings;
  cases::load_case(checkout.folder(), {{"crust.tensile_strength_Pa", "1e5"}}, findings);
  expect_findings(findings,
                  {{checkout.file(), line, "pile.held_layer_m", "cannot be used with a crust"}});
}

TEST(CheckCase, EffectOnWhatAProfileReplaces) {
  Checkout checkout;
  use_profile(checkout, "13,0\n16,6.5\n20,6\n");
  std::vector<Finding> findings;
  cases::load_case(checkout.folder(), {{"effects.pile_height", "1"}}, findings);
  expect_findings(findings, {{"--set", 0, "effects.pile_height",
                              "changes pile.height_m, which pile.profile replaces"}});
}

/// The case's classes replaced by a sieve curve.
void use_sieve(const Checkout& checkout, const std::string& rows, const std::string& keys) {
  const std::string text = read_text(checkout.file());
  const auto from = std::min(text.find("  classes:"), text.find("  sieve:")),
             to = text.find("contact:");
  write_text(checkout.file(),
             text.substr(0, from) + "  sieve: {file: sieve.csv, " + keys + "}\n" + text.substr(to));
  write_text(checkout.folder() / "sieve.csv", "size_m,passing_percent\n" + rows);
}

TEST(CheckCase, SieveCurveInPlaceOfClasses) {
  Checkout checkout;
  use_sieve(checkout, "0.15,0\n0.25,40\n0.4,60\n0.8,100\n",
            "classes: 3, spheres_below_m: 0.25, shapes: [block, shard]");
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  ASSERT_TRUE(findings.empty()) << to_string(findings[0]);
  ASSERT_EQ(c.rock.classes.size(), 3U);
  EXPECT_EQ(c.rock.classes[0].shapes, std::vector<std::string>{"sphere"});
  EXPECT_EQ(c.rock.classes[2].shapes, (std::vector<std::string>{"block", "shard"}));
  EXPECT_NE(c.text.find("rock.classes.2.size_m="), std::string::npos);
  EXPECT_EQ(c.text.find("rock.sieve"), std::string::npos);  // the text is a case: one of the two
  expect_findings(check(checkout), {});
}

TEST(CheckCase, TheTextOfASieveCaseIsACase) {
  Checkout checkout;
  use_sieve(checkout, "0.15,0\n0.25,40\n0.4,60\n0.8,100\n",
            "classes: 3, spheres_below_m: 0.25, shapes: [block, shard]");
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  std::vector<cases::Override> lines;
  for (const CaseLine& line : CaseLines(c.text)) lines.push_back({line.key, line.value});
  const cases::Case again = cases::load_case(checkout.folder(), lines, findings);
  expect_findings(findings, {});
  EXPECT_EQ(again.text, c.text);
}

TEST(CheckCase, SieveFaults) {
  Checkout checkout;
  use_sieve(checkout, "0.15,0\n0.25,140\n", "classes: 3");
  const int line = checkout.line("sieve:");
  expect_findings(load_findings(checkout),
                  {{checkout.folder() / "sieve.csv", 3, "rock.sieve.file", "passing_percent is"}});
  use_sieve(checkout, "0.15,0\n0.25,100\n", "min_size_m: 0.3");
  expect_findings(load_findings(checkout),
                  {{checkout.file(), line, "rock.sieve", "nothing between the smallest size"}});
}

TEST(CheckCase, SieveInMillimetresBelowTen) {
  Checkout checkout;
  use_sieve(checkout, "1.5,10\n4,99\n9,100\n", "classes: 2");
  expect_findings(check(checkout), {{checkout.file(), checkout.line("sieve:"), "rock.sieve.file",
                                     "sizes in mm or cm, perhaps?"}});
}

TEST(CheckCase, SieveAndClasses) {
  Checkout checkout;
  const int line = checkout.replace("coarse_graining", "coarse_graining: 2\nsieve: {file: a.csv}");
  expect_findings(load_findings(checkout),
                  {{checkout.file(), line + 1, "rock.sieve",
                    "the case has rock.classes as well; write the sizes"}});
}

TEST(CheckCase, ClassWithoutARock) {
  Checkout checkout;
  const int line = checkout.replace(
      "name: d600", "- {name: d600, size_m: 9.5, mass_percent: 44, shapes: [block]}");
  expect_findings(check(checkout), {{checkout.file(), line, "rock.classes.3.mass_percent",
                                     "rocks of d600; write a size_m below "}});
}

TEST(CheckCase, WindowLongerThanTheRun) {
  Checkout checkout;
  const int sync = checkout.replace("sync_steps", "sync_steps: 100000");
  expect_findings(
      check(checkout, {{"end_s", "5"}, {"dem.timestep_s", "1e-4"}}),
      {{checkout.file(), sync, "coupling.sync_steps",
        "a sync step of 100000 DEM steps takes 10 s, longer than the 5 s simulated; write at most "
        "50000"}});
}

TEST(CheckCase, EndBeforeTheFirstStep) {
  Checkout checkout;
  expect_findings(check(checkout, {{"end_s", "1e-5"}, {"dem.timestep_s", "1e-4"}}),
                  {{"--set", 0, "end_s", "1e-05 s is shorter than a DEM step, 0.0001 s"}});
}

TEST(CheckCase, BodiesThatTheMachineDoesNotHave) {
  Checkout checkout;
  const int line = checkout.replace("dipper:", "bucket: ../../meshes/dipper.stl");
  expect_findings(check(checkout), {{checkout.file(), line, "bodies.bucket",
                                     "the machine has no such body; it has dipper and door"},
                                    {checkout.file(), checkout.line("bodies"), "bodies.dipper",
                                     "missing key; it is what digs"}});
}

TEST(CheckCase, APlanInAnotherUnit) {
  const fs::path quick = test::source() / "cases/quick";
  const fs::path plan = fs::path(testing::TempDir()) / "odd_plan.yaml";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = read_text(quick / "plan.yaml");
    text.replace(text.find(from), from.size(), to);
    write_text(plan, text);
    std::vector<Finding> findings;
    const cases::Case c = cases::load_case(quick, {{"machine.plan", plan.string()}}, findings);
    expect_findings(findings, {});
    std::string said;
    for (const Finding& f : check_case(c)) said += to_string(f) + "\n";
    return said;
  };
  EXPECT_EQ(with("cycle_s", "cycle_s"), "");
  EXPECT_THAT(with("dump_deg: 80", "dump_deg: 1.4"), HasSubstr("dump_deg: is 1.4 degrees, less"));
  EXPECT_THAT(with("door_deg: 75", "door_deg: 1.3"), HasSubstr("door_deg: is 1.3 degrees, less"));
  EXPECT_THAT(with("depth_m: [", "depth_m: [-"), HasSubstr("depth_m: begins at -"));
}

TEST(CheckCase, AMachineAboveTheGround) {
  const Checkout checkout;
  const auto findings = check(checkout, {{"machine.base_position_m", "[0, 0, 0.5]"}});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(to_string(findings[0]),
              HasSubstr("machine.base_position_m: z is 0.5 m; machine and"));
}

TEST(CheckCase, ABoomThatLeavesTheBenchAtItsSide) {
  const Checkout checkout;
  std::vector<Finding> findings;
  cases::Case c = cases::load_case(checkout.folder(), {}, findings);
  c.machine.base_position_m = {0, 0, 0};
  const auto straight = deck::bench_along_boom(c, 0);
  const double heading = std::atan2(c.pile.width_m / 2, 14);  // the wall is met at x = 14
  const auto section = deck::bench_along_boom(c, heading);
  ASSERT_GE(section.size(), 4U);
  EXPECT_NEAR(section.back().x(), 14 / std::cos(heading), 1e-9);
  EXPECT_EQ(section.back().y(), 0);
  EXPECT_NEAR(section[section.size() - 2].y(), std::tan(35 * M_PI / 180) * (14 - c.pile.toe_x_m),
              1e-9);
  c.machine.base_position_m = {0, c.pile.width_m, 0};
  EXPECT_EQ(deck::bench_along_boom(c, 0).size(), 1U);
  EXPECT_EQ(straight.size(), 4U);
}

TEST(CheckCase, ABoomThatPointsAwayFromTheBenchMeetsNone) {
  const Checkout checkout;
  std::vector<Finding> findings;
  const cases::Case c = read_case(checkout.folder(), {}, findings);
  expect_findings(findings, {});
  EXPECT_EQ(deck::bench_along_boom(c, 0).size(), 4U);
  for (const double heading_rad : {M_PI / 2, -M_PI / 2, M_PI}) {
    const auto section = deck::bench_along_boom(c, heading_rad);
    for (const auto& point : section) EXPECT_EQ(point.y(), 0);
    EXPECT_LE(section.back().x(), c.domain.max_m.x() - c.machine.base_position_m.x());
  }
}

TEST(CheckCase, ADipperWithoutADoor) {
  Checkout checkout;
  const int line = checkout.replace("door:", "flap: ../../meshes/door.stl");
  expect_findings(check(checkout), {{checkout.file(), line, "bodies.flap",
                                     "the machine has no such body; it has dipper and door"},
                                    {checkout.file(), checkout.line("bodies"), "bodies.door",
                                     "missing key; without it the dipper holds nothing"}});
}

TEST(CheckedCase, SoundCase) {
  const Checkout checkout;
  test::MemoryReporter out;
  EXPECT_TRUE(checked_case(checkout.folder(), {}, out));
  EXPECT_THAT(
      out.lines,
      MatchesRegex("quick is sound: about [0-9]+ rocks poured; [0-9.]+ s simulated in [0-9]+ DEM "
                   "steps and [0-9]+ sync steps of [0-9.]+ ms, after [0-9]+ DEM steps to settle "
                   "the pile; the DEM step is [0-9]+ % of the largest stable one, [0-9.]+ s\n"
                   "estimate: .* accurate within a factor of 2\n"
                   "pass 1: the teeth sweep [0-9]+ m3, up to [0-9.]+ m deep; the dipper's "
                   "struck volume is 42 m3\n"
                   "warning: .*machine.motion: pass 1 cannot fill the dipper; .*\n"));
}

TEST(CheckedCase, PrintsEveryFindingAndTheirNumber) {
  Checkout checkout;
  const int line = checkout.replace("ranks", "ranks: none");
  test::MemoryReporter out;
  EXPECT_FALSE(checked_case(checkout.folder(), {{"dem.timestep_s", "-1"}}, out));
  EXPECT_EQ(out.lines, "--set: dem.timestep_s: -1 is out of range; allowed is > 0 and <= 0.1 s\n" +
                           checkout.file().string() + ":" + std::to_string(line) +
                           ": dem.ranks: is 'none'; write a whole number\n2 errors\n");
}

}  // namespace
}  // namespace dipper::check
