#include <gtest/gtest.h>

#include "coupler/case/case.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::cases {
namespace {

using test::Checkout;
using test::expect_findings;

// A case that includes another, which includes a file with rock.
struct Included : testing::Test {
  Included() {
    test::write_text(checkout.root / "cases/dense.yaml",
                     "rock:\n  density_kg_m3: 4000\n  poisson_ratio: 0.2\nbodies:\n"
                     "  dipper: ../nowhere.stl\n");
    checkout.replace("density_kg_m3", "");
    checkout.replace("seed", "seed: 1\ninclude: ../dense.yaml");
    test::fs::create_directories(other);
    test::write_text(other / "case.yaml",
                     "include: ../quick/case.yaml\nseed: 2\ndem:\n  ranks: 1\n");
  }

  Case load(std::vector<Finding>& findings) const { return load_case(other, {}, findings); }

  Checkout checkout;
  test::fs::path other = checkout.root / "cases/other";
};

TEST_F(Included, NearerFilesOverrideAndPathsStartAtTheirFile) {
  std::vector<Finding> findings;
  const Case c = load(findings);
  expect_findings(findings, {});
  EXPECT_EQ(c.name, "other");
  EXPECT_EQ(c.seed, 2);
  EXPECT_EQ(c.dem.ranks, 1);
  EXPECT_EQ(c.rock.density_kg_m3, 4000);  // of the file two steps away
  EXPECT_NE(c.rock.poisson_ratio, 0.2);   // the case between has its own
  EXPECT_EQ(c.bodies.at("dipper"), checkout.root / "meshes/dipper.stl");
  EXPECT_EQ(c.machine.motion, checkout.folder() / "motion.csv");
}

TEST_F(Included, ACircleIsNamed) {
  test::write_text(checkout.root / "cases/dense.yaml", "include: other/case.yaml\n");
  std::vector<Finding> findings;
  load(findings);
  ASSERT_FALSE(findings.empty());
  EXPECT_NE(
      to_string(findings[0])
          .find("dense.yaml:1: include: " + (other / "case.yaml").string() + " includes this file"),
      std::string::npos)
      << to_string(findings[0]);
}

TEST_F(Included, AMissingFileIsAtTheLineThatNamesIt) {
  const int line = checkout.replace("include", "include: ../nowhere.yaml");
  std::vector<Finding> findings;
  load(findings);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0].file, checkout.file());
  EXPECT_EQ(findings[0].line, line);
  EXPECT_NE(findings[0].message.find("nowhere.yaml is not a file"), std::string::npos);
}

}  // namespace
}  // namespace dipper::cases
