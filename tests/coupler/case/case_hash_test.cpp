#include "coupler/case/case_hash.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "coupler/case/case_text.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::cases {
namespace {

using test::Checkout;
namespace fs = std::filesystem;

Case load(const fs::path& folder, const std::vector<Override>& set = {}) {
  std::vector<Finding> findings;
  Case c = load_case(folder, set, findings);
  test::expect_findings(findings, {});
  return c;
}

TEST(CaseText, IsSortedAndHasEveryDigit) {
  const Checkout checkout;
  const std::string text = load(checkout.folder(), {{"contact.friction_dipper", "0.1"}}).text;
  EXPECT_NE(text.find("\ncontact.friction_dipper=0.10000000000000001\n"), std::string::npos);
  EXPECT_NE(text.find("\ntruck.mesh=\"../../meshes/truck.stl\"\n"), std::string::npos);
  std::istringstream in(text);
  std::string before;
  for (std::string line; std::getline(in, line); before = line) EXPECT_LT(before, line);
}

TEST(CaseText, SetsTheSameCaseWhenGivenAsOverrides) {
  const Checkout checkout;
  const Case c = load(checkout.folder(), {{"title", "'a \"b\" \\ #: x'"},
                                          {"rock.density_kg_m3", "3612.3"},
                                          {"machine.base_position_m", "[0.1, -0.0, 1e-9]"}});
  std::vector<Override> set;
  std::istringstream in(c.text);
  for (std::string line; std::getline(in, line);) {
    const auto equals = line.find('=');
    set.push_back({line.substr(0, equals), line.substr(equals + 1)});
  }
  EXPECT_EQ(load(checkout.folder(), set).text, c.text);
}

TEST(CaseText, DoesNotKnowCommentsOrOrder) {
  Checkout checkout;
  const std::string before = load(checkout.folder()).text;
  checkout.replace("seed", "# a comment\nseed:   1   # more");
  checkout.replace("youngs_modulus_Pa", "youngs_modulus_Pa: 45000000000.0");
  EXPECT_EQ(load(checkout.folder()).text, before);
}

TEST(CaseHash, FollowsEveryValueAndEveryReferencedByte) {
  const Checkout checkout;
  std::set<std::string> hashes{case_hash(load(checkout.folder()))};
  hashes.insert(case_hash(load(checkout.folder(), {{"seed", "2"}})));
  EXPECT_EQ(hashes.size(), 2U);

  const auto files = referenced_files(load(checkout.folder()));
  EXPECT_EQ(files.size(), 7U + 2 * 3)
      << "model, motion, 3 walls, 2 files beside them; STL and YAML of 3 shapes";
  for (const fs::path& file : files) {
    const std::string bytes = test::read_text(file);
    std::string changed = bytes;
    changed.back() = static_cast<char>(changed.back() ^ 1);
    test::write_text(file, changed);
    EXPECT_TRUE(hashes.insert(case_hash(load(checkout.folder()))).second) << file;
    test::write_text(file, bytes);
  }
  EXPECT_FALSE(hashes.insert(case_hash(load(checkout.folder()))).second);
}

TEST(CaseHash, FollowsTheBytesOfAProfile) {
  Checkout checkout;
  checkout.replace("toe_x_m", "profile: scan.csv");
  for (const char* key : {"height_m", "crest_depth_m", "face_angle_deg"}) checkout.replace(key, "");
  std::set<std::string> hashes;
  for (const char* rows : {"13,0\n16,6\n", "13,0\n16,7\n"}) {
    test::write_text(checkout.folder() / "scan.csv", std::string("x_m,z_m\n") + rows);
    const Case c = load(checkout.folder());
    hashes.insert(case_hash(c));
    const auto files = referenced_files(c);
    EXPECT_EQ(std::count(files.begin(), files.end(), c.pile.profile), 1);
  }
  EXPECT_EQ(hashes.size(), 2U);
}

TEST(CaseHash, ASieveCurveIsOneOfTheCasesFiles) {
  const Checkout checkout;
  Case c = load(checkout.folder());
  c.rock.sieve.file = checkout.folder() / "sieve.csv";
  const auto files = referenced_files(c);
  EXPECT_EQ(std::count(files.begin(), files.end(), c.rock.sieve.file), 1);
}

TEST(CaseHash, DoesNotKnowWhereTheCheckoutIs) {
  const Checkout one;
  const Checkout other;
  const fs::path deeper = other.root / "a/b";
  fs::create_directories(deeper);
  for (const char* part : {"cases", "meshes", "mbs"}) fs::rename(other.root / part, deeper / part);
  EXPECT_EQ(case_hash(load(one.folder())), case_hash(load(deeper / "cases/quick")));
}

TEST(CaseHash, AMeshWithAnotherNameAndTheSameBytesIsTheSame) {
  const Checkout checkout;
  const std::string before = case_hash(load(checkout.folder()));
  for (const char* type : {".stl", ".yaml"})
    fs::copy(checkout.root / (std::string("meshes/truck") + type),
             checkout.root / (std::string("lorry") + type));
  EXPECT_EQ(
      case_hash(load(checkout.folder(), {{"truck.mesh", (checkout.root / "lorry.stl").string()}})),
      before);
}

TEST(CaseHash, ThrowsForAMissingFile) {
  const Checkout checkout;
  fs::remove(checkout.root / "meshes/truck.stl");
  EXPECT_THROW(case_hash(load(checkout.folder())), std::runtime_error);
}

}  // namespace
}  // namespace dipper::cases
