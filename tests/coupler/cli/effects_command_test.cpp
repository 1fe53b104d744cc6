#include "coupler/cli/effects_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char* const kMine =
    "title: Mine\nkind: machine\nsignature: s\nnuisance: true\n"
    "parameter: {name: p, unit: m, low: -1, high: 2, scale: 0.5, source: here}\n"
    "overlay:\n  rock.density_kg_m3: {scale: 0.1}\n  machine.crowd_friction_N: {add: 3}\n";

class EffectsCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "effects");
    std::ofstream(folder_ / "case.yaml") << "seed: 1\n";
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& text) { std::ofstream(folder_ / "effects/mine.yaml") << text; }

  fs::path folder_ = fs::path(::testing::TempDir()) / "effects_command";
};

TEST_F(EffectsCommand, ListsTheCataloguesAndTheCasesOwn) {
  write(kMine);
  test::MemoryReporter out;
  ASSERT_EQ(effects_command(folder_, out), 0);
  const json effects = json::parse(out.lines).at("effects");
  EXPECT_GT(effects.size(), 12U);
  const auto mine = std::find_if(effects.begin(), effects.end(),
                                 [](const json& e) { return e.at("name") == "mine"; });
  ASSERT_NE(mine, effects.end());
  EXPECT_EQ(*mine, json::parse(R"({"name": "mine", "title": "Mine", "kind": "machine",
    "signature": "s", "nuisance": true,
    "parameter": {"name": "p", "unit": "m", "low": -1.0, "high": 2.0, "scale": 0.5,
                  "source": "here"},
    "overlay": [{"key": "rock.density_kg_m3", "how": "scale", "factor": 0.1},
                {"key": "machine.crowd_friction_N", "how": "add", "factor": 3.0}],
    "affects": "settling"})"));
  const auto friction = std::find_if(effects.begin(), effects.end(), [](const json& e) {
    return e.at("name") == "crowd_friction";
  });
  EXPECT_EQ(friction->at("affects"), "machine");
}

TEST_F(EffectsCommand, FaultsAreReportedAllAtOnceAndNothingIsWritten) {
  std::string bad = kMine;
  bad.replace(bad.find("machine\n"), 7, "magic");
  bad.replace(bad.find("scale: 0.5"), 10, "scale: 0.0");
  write(bad);
  test::MemoryReporter out;
  EXPECT_EQ(effects_command(folder_, out), 2);
  const std::string said = out.errors;
  EXPECT_EQ(out.lines, "");
  for (const char* what : {"kind: is 'magic'", "parameter.scale: 0.0 is out of range"})
    EXPECT_NE(said.find(what), std::string::npos) << what << " in " << said;
}

TEST_F(EffectsCommand, AFolderThatIsNoCaseIsRefused) {
  fs::remove(folder_ / "case.yaml");
  test::MemoryReporter out;
  EXPECT_EQ(effects_command(folder_, out), 2);
  EXPECT_EQ(out.lines, "");
  EXPECT_NE(out.errors.find("is not a case"), std::string::npos) << out.errors;
}

}  // namespace
}  // namespace dipper::cli
