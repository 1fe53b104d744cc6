#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/case/case.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::cases {
namespace {

using test::Checkout;
using test::expect_findings;

std::vector<Finding> findings_of(const Checkout& checkout, const std::vector<Override>& set = {}) {
  std::vector<Finding> findings;
  load_case(checkout.folder(), set, findings);
  return findings;
}

TEST(LoadCase, QuickIsSound) {
  const Checkout checkout;
  std::vector<Finding> findings;
  const Case c = load_case(checkout.folder() / "", {}, findings);
  expect_findings(findings, {});
  EXPECT_EQ(c.name, "quick");
  EXPECT_EQ(c.rock.density_kg_m3, 3215);
  EXPECT_EQ(c.rock.youngs_modulus_Pa, 45e9);
  EXPECT_EQ(c.rock.classes.size(), 4U);
  EXPECT_EQ(c.rock.classes[0].shapes, std::vector<std::string>{"sphere"});
  EXPECT_EQ(c.truck.mesh, checkout.root / "meshes/truck.stl");
  EXPECT_EQ(c.bodies.at("door"), checkout.root / "meshes/door.stl");
  EXPECT_EQ(c.end_s, 0);
}

// One mistake a case: the line that begins with `at` becomes `text`.
struct Mistake {
  std::string at;
  std::string text;
  int below;  // the finding's line, counted from the replaced one
  std::string key;
  std::string message;
};

void PrintTo(const Mistake& m, std::ostream* out) { *out << m.at << " -> " << m.text; }

class OneMistake : public testing::TestWithParam<Mistake> {};

TEST_P(OneMistake, IsReportedOnceWithItsLine) {
  const Mistake& m = GetParam();
  Checkout checkout;
  const int line = checkout.replace(m.at, m.text);
  expect_findings(findings_of(checkout), {{checkout.file(), line + m.below, m.key, m.message}});
}

INSTANTIATE_TEST_SUITE_P(
    UnknownKeys, OneMistake,
    testing::Values(
        Mistake{"density_kg_m3", "density_t_m3: 3.7", 0, "rock.density_t_m3",
                "unknown key; the unit here is kg/m3: density_kg_m3"},
        Mistake{"density_kg_m3", "density: 3700", 0, "rock.density",
                "unknown key; the unit here is kg/m3: density_kg_m3"},
        Mistake{"timestep_s", "timestep_us: 45", 0, "dem.timestep_us",
                "unknown key; the unit here is s: timestep_s"},
        Mistake{"youngs_modulus_Pa", "youngs_modulus_GPa: 45", 0, "rock.youngs_modulus_GPa",
                "unknown key; the unit here is Pa: youngs_modulus_Pa"},
        Mistake{"name: d200", "- {name: d200, size_mm: 200, mass_percent: 37, shapes: [sphere]}", 0,
                "rock.classes.0.size_mm", "unknown key; the unit here is m: size_m"},
        Mistake{"friction_dipper", "friction_diper: 0.5", 0, "contact.friction_diper",
                "unknown key; did you mean friction_dipper?"},
        Mistake{"poisson_ratio", "poisson_ratio: 0.3\ndump_every_s: 1", 1, "rock.dump_every_s",
                "unknown key; it belongs in output"},
        Mistake{"seed", "seed: 1\nranks: 4", 1, "ranks", "unknown key; it belongs in dem"},
        Mistake{"seed", "seed: 1\nweather: dry", 1, "weather", "unknown key; a case has format"},
        Mistake{"ranks", "ranks: 2\ngpu: yes", 1, "dem.gpu",
                "unknown key; dem has timestep_s, ranks"}));

INSTANTIATE_TEST_SUITE_P(
    MissingAndDoubleKeys, OneMistake,
    testing::Values(Mistake{"format", "", 0, "format", "missing key; write a whole number"},
                    Mistake{"name: d200", "- {name: d200, size_m: 0.2, shapes: [sphere]}", 0,
                            "rock.classes.0.mass_percent", "missing key; write a number in %"},
                    Mistake{"seed", "seed: 1\nseed: 2", 1, "seed", "given twice, first in line "}));

INSTANTIATE_TEST_SUITE_P(
    WrongTypes, OneMistake,
    testing::Values(
        Mistake{"density_kg_m3", "density_kg_m3: 3.7 t/m3", 0, "rock.density_kg_m3",
                "is '3.7 t/m3'; write a number in kg/m3"},
        Mistake{"density_kg_m3", "density_kg_m3: \"3700\"", 0, "rock.density_kg_m3",
                "is \"3700\"; write a number in kg/m3"},
        Mistake{"density_kg_m3", "density_kg_m3:", 0, "rock.density_kg_m3",
                "is nothing; write a number in kg/m3"},
        Mistake{"density_kg_m3", "density_kg_m3: [3700]", 0, "rock.density_kg_m3",
                "is a list; write a number in kg/m3"},
        Mistake{"density_kg_m3", "density_kg_m3: .inf", 0, "rock.density_kg_m3", "is '.inf'"},
        Mistake{"density_kg_m3", "density_kg_m3: nan", 0, "rock.density_kg_m3", "is 'nan'"},
        Mistake{"density_kg_m3", "density_kg_m3: inf", 0, "rock.density_kg_m3", "is 'inf'"},
        Mistake{"density_kg_m3", "density_kg_m3: 0xE74", 0, "rock.density_kg_m3", "is '0xE74'"},
        Mistake{"density_kg_m3", "density_kg_m3: 1e999", 0, "rock.density_kg_m3", "is '1e999'"},
        Mistake{"density_kg_m3", "density_kg_m3: 3,700", 0, "rock.density_kg_m3", "is '3,700'"},
        Mistake{"ranks", "ranks: 2.5", 0, "dem.ranks", "is '2.5'; write a whole number"},
        Mistake{"min_m", "min_m: [-12, -8]", 0, "domain.min_m",
                "is a list; write three numbers [x, y, z] in m"},
        Mistake{"min_m", "min_m: [-12, a, -1]", 0, "domain.min_m.1", "is 'a'; write a number in m"},
        Mistake{"name: d200", "- {name: d200, size_m: 0.2, mass_percent: 37, shapes: sphere}", 0,
                "rock.classes.0.shapes", "is 'sphere'; write a list of names"},
        Mistake{"name: d200", "- {name: [], size_m: 0.2, mass_percent: 37, shapes: [sphere]}", 0,
                "rock.classes.0.name", "is a list; write text"},
        Mistake{"mesh", "mesh: ''", 0, "truck.mesh", "is \"\"; write a path"},
        Mistake{"seed", "seed: *other", 0, "",
                "not valid YAML: the referenced anchor is not defined"},
        Mistake{"format", "format: 1\n<<: {a: 1}", 1, "<<", "unknown key"}));

INSTANTIATE_TEST_SUITE_P(
    Nonsense, OneMistake,
    testing::Values(Mistake{"seed", "seed: 1\nend_s: 1e300", 1, "end_s",
                            "1e300 is out of range; allowed is 0 ... 100000 s"},
                    Mistake{"settle_s", "settle_s: 1e18", 0, "pile.settle_s",
                            "1e18 is out of range; allowed is 0 ... 10000 s"},
                    Mistake{"relax_s", "relax_s: 1e18", 0, "pile.relax_s",
                            "1e18 is out of range; allowed is 0 ... 10000 s"},
                    Mistake{"ranks", "ranks: 100000", 0, "dem.ranks",
                            "100000 is out of range; allowed is 1 ... 4096"},
                    Mistake{"max_m", "max_m: [1e20, 28, 24]", 0, "domain.max_m.0",
                            "1e20 is out of range; allowed is -10000 ... 10000 m"},
                    Mistake{"position_m", "position_m: [0, -1e20, 0]", 0, "truck.position_m.1",
                            "-1e20 is out of range; allowed is -10000 ... 10000 m"},
                    Mistake{"timeout_s", "timeout_s: 1e300", 0, "coupling.timeout_s",
                            "1e300 is out of range; allowed is 1 ... 86400 s"},
                    Mistake{"dump_every_s", "dump_every_s: 1e300", 0, "output.dump_every_s",
                            "1e300 is out of range; allowed is 0 ... 100000 s"}));

INSTANTIATE_TEST_SUITE_P(
    OutOfRange, OneMistake,
    testing::Values(
        Mistake{"format", "format: 2", 0, "format", "2 is out of range; allowed is 1"},
        Mistake{"density_kg_m3", "density_kg_m3: -3700", 0, "rock.density_kg_m3",
                "-3700 is out of range; allowed is 100 ... 20000 kg/m3"},
        Mistake{"poisson_ratio", "poisson_ratio: 0.5", 0, "rock.poisson_ratio",
                "0.5 is out of range; allowed is > 0 and < 0.5"},
        Mistake{"friction_ground", "friction_ground: -0.1", 0, "contact.friction_ground",
                "-0.1 is out of range; allowed is 0 ... 5"},
        Mistake{"ranks", "ranks: 0", 0, "dem.ranks", "0 is out of range; allowed is 1 ... 4096"},
        Mistake{"ranks", "ranks: 99999999999", 0, "dem.ranks", "99999999999 is out of range"},
        Mistake{"timestep_s", "timestep_s: 0", 0, "dem.timestep_s", "0 is out of range"},
        Mistake{"height_m", "height_m: -1", 0, "pile.height_m", "-1 is out of range"},
        Mistake{"name: d200", "- {name: d200, size_m: -0.2, mass_percent: 37, shapes: [sphere]}", 0,
                "rock.classes.0.size_m", "-0.2 is out of range; allowed is 0.001 ... 10 m"},
        Mistake{"name: d200", "- {name: d200, size_m: 0.2, mass_percent: 36.8, shapes: [sphere]}",
                -1, "rock.classes", "mass_percent adds up to 99.8; the classes must add up to 100"},
        Mistake{"name: d300", "- {name: d200, size_m: 0.3, mass_percent: 10, shapes: [block]}", 0,
                "rock.classes.1.name", "'d200' names two classes"},
        Mistake{"name: d300", "- {name: d-300, size_m: 0.3, mass_percent: 10, shapes: [block]}", 0,
                "rock.classes.1.name", "is a name; write letters, digits and _ only"},
        Mistake{"name: d300", "- {name: d300, size_m: 0.3, mass_percent: 10, shapes: [../x]}", 0,
                "rock.classes.1.shapes.0", "'../x' names no shape"},
        Mistake{"scheme", "scheme: corected", 0, "coupling.scheme",
                "is 'corected'; write one of corrected, serial; did you mean corrected?"},
        Mistake{"min_m", "min_m: [-12, 28.5, -1]", 0, "domain.min_m",
                "y = 28.5 is not below domain.max_m's 28"}));

TEST(LoadCase, MassPercentsMayBeRounded) {
  Checkout checkout;
  checkout.replace("name: d200",
                   "- {name: d200, size_m: 0.2, mass_percent: 36.95, shapes: [sphere]}");
  expect_findings(findings_of(checkout), {});
}

TEST(LoadCase, MissingKeyIsAtItsSection) {
  Checkout checkout;
  checkout.replace("poisson_ratio", "");
  expect_findings(findings_of(checkout), {{checkout.file(), checkout.line("rock:"),
                                           "rock.poisson_ratio", "missing key; write a number"}});
}

TEST(LoadCase, SectionGivenTwiceNamesTheFirst) {
  Checkout checkout;
  const std::string text = test::read_text(checkout.file());
  const int before = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  test::write_text(checkout.file(), text + "dem: {timestep_s: 1e-4}\n");
  expect_findings(findings_of(checkout),
                  {{checkout.file(), before + 1, "dem",
                    "given twice, first in line " + std::to_string(checkout.line("dem:"))}});
}

TEST(LoadCase, MissingSectionIsOneFinding) {
  Checkout checkout;
  test::write_text(checkout.file(), "format: 1\nseed: 1\n");
  std::vector<test::Expected> expected;
  for (const char* section : {"machine", "rock", "contact", "pile", "bodies", "truck", "domain",
                              "dem", "coupling", "output"}) {
    expected.push_back({checkout.file(), 1, section, "missing section, with the keys "});
  }
  expect_findings(findings_of(checkout), expected);
}

TEST(LoadCase, EveryErrorAtOnce) {
  Checkout checkout;
  const int density = checkout.replace("density_kg_m3", "density_t_m3: 3.7");
  const int poisson = checkout.replace("poisson_ratio", "poisson_ratio: 0.7");
  const int toe = checkout.replace("toe_x_m", "toe_x_m: 13 m");
  const int ranks = checkout.replace("ranks", "ranks: 0\nranks: 1");
  const int scheme = checkout.replace("scheme", "scheme: parallel");
  const auto file = checkout.file();
  expect_findings(findings_of(checkout, {{"dem.timestep_s", "fast"}, {"rock.sise", "1"}}),
                  {{file, density, "rock.density_t_m3", "the unit here is kg/m3"},
                   {file, poisson, "rock.poisson_ratio", "out of range"},
                   {file, toe, "pile.toe_x_m", "is '13 m'; write a number in m"},
                   {file, ranks, "dem.ranks", "0 is out of range"},
                   {file, ranks + 1, "dem.ranks", "given twice"},
                   {file, scheme, "coupling.scheme", "write one of corrected, serial"},
                   {"--set", 0, "dem.timestep_s", "is 'fast'; write a number in s, or auto"},
                   {"--set", 0, "rock.sise", "unknown key"}});
}

TEST(LoadCase, SyntaxErrorsHaveTheirLine) {
  const Checkout checkout;
  test::write_text(checkout.file(), "format: 1\nrock: {density_kg_m3: 3700\nseed: 1\n");
  const auto findings = findings_of(checkout);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].line, 3);
  EXPECT_EQ(findings[0].message.rfind("not valid YAML: ", 0), 0U) << findings[0].message;

  test::write_text(checkout.file(), "format: 1\n? [a, b]\n: 2\n");
  expect_findings(findings_of(checkout), {{checkout.file(), 2, "", "a key must be a plain word"}});
}

TEST(LoadCase, TextIsUtf8) {
  Checkout checkout;
  checkout.replace("title",
                   "title: Gr\xC3\xB6\xC3\x9F"
                   "e, 4 \xE2\x84\xA6 \xF0\x9F\xAA\xA8");
  expect_findings(findings_of(checkout), {});
  for (const char* word : {"Gr\xF6\xDF"
                           "e",
                           "\xC0\xAF", "\xED\xA0\x80", "\xF5", "end\xE2\x84"}) {
    const int line = checkout.replace("title", std::string("title: ") + word);
    expect_findings(findings_of(checkout),
                    {{checkout.file(), line, "", "holds a byte that is not UTF-8"}});
  }
}

TEST(LoadCase, AliasesAreNotFollowed) {
  Checkout checkout;
  checkout.replace("seed", "seed: &s 1");
  const int line = checkout.replace("ranks", "ranks: *s");
  expect_findings(findings_of(checkout),
                  {{checkout.file(), line, "dem.ranks", "aliases (*name) are not read"},
                   {checkout.file(), line, "dem.ranks", "is nothing; write a whole number"}});
}

TEST(LoadCase, NoCaseThere) {
  const Checkout checkout;
  std::vector<Finding> findings;
  load_case(checkout.root, {}, findings);
  load_case(checkout.file(), {}, findings);
  expect_findings(findings, {{checkout.root / "case.yaml", 0, "", "cannot be read"},
                             {checkout.file(), 0, "", "is a file; name its folder"}});
}

TEST(LoadCase, SeveralDocumentsAreAnError) {
  const Checkout checkout;
  test::write_text(checkout.file(), test::read_text(checkout.file()) + "---\nformat: 1\n");
  expect_findings(findings_of(checkout),
                  {{checkout.file(), 0, "", "holds several YAML documents"}});
}

TEST(Override, ReplacesNumbersListElementsAndSections) {
  const Checkout checkout;
  std::vector<Finding> findings;
  const Case c = load_case(checkout.folder(),
                           {{"rock.density_kg_m3", "3600"},
                            {"rock.classes.0.size_m", "0.25"},
                            {"domain.max_m", "[40, 30, 25]"},
                            {"domain.max_m.2", "26"},
                            {"end_s", "5"},
                            {"truck.mesh", "other.stl"}},
                           findings);
  expect_findings(findings, {});
  EXPECT_EQ(c.rock.density_kg_m3, 3600);
  EXPECT_EQ(c.rock.classes[0].size_m, 0.25);
  EXPECT_EQ(c.domain.max_m, Eigen::Vector3d(40, 30, 26));
  EXPECT_EQ(c.end_s, 5);
  EXPECT_EQ(c.truck.mesh, checkout.folder() / "other.stl");
  EXPECT_EQ(c.origins.at("end_s").file, "--set");
}

TEST(Override, ErrorsNameSet) {
  const Checkout checkout;
  expect_findings(findings_of(checkout, {{"rock.classes.7.size_m", "1"},
                                         {"rock.density_t_m3", "3.7"},
                                         {"title", "\"open"},
                                         {"dem.ranks", "0"},
                                         {"truck", "none"},
                                         {"rock..x", "1"}}),
                  {{"--set", 0, "rock.classes.7.size_m", "no element 7; the list has 0 ... 3"},
                   {"--set", 0, "rock.density_t_m3", "the unit here is kg/m3: density_kg_m3"},
                   {"--set", 0, "title", "not valid YAML"},
                   {"--set", 0, "dem.ranks", "0 is out of range"},
                   {"--set", 0, "truck", "is 'none'; write a section with the keys mesh"},
                   {"--set", 0, "rock..x", "not a key"}});
}

TEST(Finding, ReadsAsACompilerMessage) {
  EXPECT_EQ(to_string(Finding{"c/case.yaml", 3, "rock.size", "is wrong"}),
            "c/case.yaml:3: rock.size: is wrong");
  EXPECT_EQ(to_string(Finding{"--set", 0, "a", "is wrong"}), "--set: a: is wrong");
}

}  // namespace
}  // namespace dipper::cases
