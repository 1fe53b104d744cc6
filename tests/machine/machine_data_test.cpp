#include "machine/machine_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/common/input_errors.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::filesystem::path kMachine = test::source() / "mbs/bucyrus495.yaml";

/// The faults of the real file after replacing its first `from` by `to`.
std::vector<std::string> faults_with(const std::string& from, const std::string& to) {
  std::ifstream in(kMachine);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, from.size(), to);
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto file =
      std::filesystem::path(testing::TempDir()) / (std::string(test->name()) + ".yaml");
  std::ofstream(file) << text;
  return test::faults_of([&] { load_machine(file); });
}

TEST(MachineData, HoldsThePapersNumbers) {
  const MachineData m = load_machine(kMachine);
  EXPECT_EQ(m.machine, "Bucyrus 495");
  EXPECT_EQ(m.dipper.struck_volume, 42);
  EXPECT_EQ(m.dipper.rated_load, 109e3);
  EXPECT_TRUE(m.dipper.rated_load_assumed);
  EXPECT_EQ(m.dipper.inside, Vector3d(4, 4, 3));
  EXPECT_NEAR(m.dipper.base_rake, 61.8 * M_PI / 180, 1e-12);
  EXPECT_EQ(m.rope.elastic_fraction, 0.3);
  EXPECT_EQ(m.dipper.mass + m.door.mass, 50e3);
  EXPECT_LE(m.limits.crowd_min, -1.5);
  EXPECT_GE(m.limits.crowd_max, 3);
}

// A source is the paper, another publication, with its year or number, or an assumption with its
// grounds.
TEST(MachineData, SaysWhereEveryNumberComesFrom) {
  const std::regex source("source: \"([^\"]*)\"");
  const std::regex sound("paper [A-Z0-9].*|assumed: .{5,}|.*((19|20)[0-9]{2}|10\\.[0-9]{4}/).*");
  int numbers = 0;
  for (const auto& file : std::filesystem::directory_iterator(kMachine.parent_path())) {
    if (file.path().extension() != ".yaml") continue;
    std::ifstream in(file.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch found;
      if (!std::regex_search(line, found, source)) continue;
      EXPECT_TRUE(std::regex_match(found[1].str(), sound)) << file.path() << ": " << line;
      ++numbers;
    }
  }
  EXPECT_GE(numbers, 2 * 51);
}

TEST(MachineData, NamesAnUnknownKey) {
  EXPECT_THAT(faults_with("sheave_radius:", "sheave_radios:"),
              testing::UnorderedElementsAre(HasSubstr("boom.sheave_radius: missing key"),
                                            HasSubstr("boom.sheave_radios: unknown key")));
  EXPECT_THAT(faults_with("\nrope:", "\nrope_:"),
              testing::UnorderedElementsAre(HasSubstr("rope: missing key"),
                                            HasSubstr("rope_: unknown key")));
}

TEST(MachineData, NamesAWrongUnitWithItsLine) {
  EXPECT_THAT(faults_with("unit: kg m^2", "unit: t m^2"),
              ElementsAre(testing::ContainsRegex(
                  "yaml:[0-9]+: house.swing_inertia.unit: is 't m.2'; it must be 'kg m.2'")));
}

TEST(MachineData, WantsANumberAUnitAndASource) {
  EXPECT_THAT(faults_with("value: 1.2,", "value: wide,"),
              ElementsAre(HasSubstr("boom.sheave_radius.value: is 'wide'; write a number in m")));
  EXPECT_THAT(faults_with("value: 1.2,", "value: -1.2,"),
              ElementsAre(HasSubstr("-1.2 is out of range; allowed is > 0")));
  EXPECT_THAT(faults_with("value: 1.2,", "value: .nan,"),
              ElementsAre(HasSubstr("is '.nan'; write a number in m")));
  EXPECT_THAT(faults_with("value: 1.2, ", ""),
              Contains(HasSubstr("boom.sheave_radius.value: missing key")));
  EXPECT_THAT(faults_with("source: \"paper 2.2\"", "source: \"\""),
              Contains(HasSubstr("source: is empty")));
  EXPECT_THAT(faults_with("[16.83, 0.0, 18.43]", "[16.83, 18.43]"),
              Contains(HasSubstr("three numbers")));
}

TEST(MachineData, RefusesWhatNoMachineHas) {
  EXPECT_THAT(faults_with("damping: {value: ", "damping: {value: -"),
              ElementsAre(HasSubstr("is out of range; allowed is >= 0")));
  EXPECT_THAT(faults_with("elastic_fraction: {value: 0.3", "elastic_fraction: {value: 5"),
              ElementsAre(HasSubstr("5 is out of range; allowed is > 0 and <= 1")));
  EXPECT_THAT(faults_with("\nrope:", "\nmachine: {value: twice}\nrope:"),
              ElementsAre(HasSubstr("machine: given twice, first in line")));
}

// The keys that files may lack.
TEST(MachineData, ReadsTheRopeModel) {
  EXPECT_FALSE(load_machine(kMachine).rope.segmented);
  EXPECT_EQ(load_machine(kMachine).rope.mass_per_length, 22);
  EXPECT_THAT(
      faults_with("model: {value: elastic", "model: {value: chain"),
      ElementsAre(HasSubstr("rope.model.value: is 'chain'; it must be elastic or segmented")));
  EXPECT_THAT(faults_with("elements: {value: 19", "elements: {value: 1"),
              ElementsAre(HasSubstr("1 is out of range")));
  EXPECT_THAT(faults_with("  model: {", "  # model: {"), testing::IsEmpty());
}

TEST(MachineData, SaysWhenTheFileIsNotThereOrNotYaml) {
  EXPECT_THROW(load_machine("/nowhere/machine.yaml"), InputError);
  EXPECT_THAT(faults_with("boom:\n", "boom: {\n"), testing::SizeIs(1));
}

}  // namespace
}  // namespace dipper::machine
