// A wall that leaves the box ends LIGGGHTS; its own message says so. On 1 and on 2 ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupler/launch/mpirun.hpp"
#include "coupler/launch/process.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/places.hpp"

namespace dipper::dem {
namespace {

std::string text(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

class Runaway : public testing::TestWithParam<int> {};

TEST_P(Runaway, EndsTheProcessWithLiggghtssMessageOnTheScreen) {
  const int ranks = GetParam();
  const auto folder =
      std::filesystem::temp_directory_path() / ("dipper_runaway_" + std::to_string(ranks));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  setup::RockSetup setup;
  setup.deck = (test::dem_tests() / "pose.in").string();
  setup.log = folder / "log.liggghts";
  setup.screen = folder / "screen.liggghts";
  setup.bodies = {"dipper", "door"};
  setup.variables = {{"run_steps", "0"}};
  for (const auto& body : setup.bodies) {
    const std::string stl = folder / (body + ".stl");
    std::ofstream(stl) << test::ascii_stl(test::box(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
    setup.variables.push_back({body, stl});
  }
  const std::string config = folder / "setup.json";
  std::ofstream(config) << to_json(setup);

  const std::string program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "dem_runaway";
  launch::Process process(ranks == 1 ? std::vector<std::string>{program, config}
                                     : launch::mpirun(ranks, {program, config}),
                          folder / "output.txt");
  ASSERT_TRUE(process.wait(std::chrono::seconds(60))) << text(folder / "output.txt");
  EXPECT_FALSE(process.succeeded());
  EXPECT_THAT(text(setup.screen), testing::AllOf(testing::HasSubstr("ERROR: Mesh (id dipper)"),
                                                 testing::HasSubstr("left the domain")));
  std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(Ranks, Runaway, testing::Values(1, 2));

}  // namespace
}  // namespace dipper::dem
