#include "machine/machine_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "common/angles.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kSource = test::source();

std::vector<std::string> faults_of_495(const std::function<void(MachineData&)>& change) {
  MachineData m = load_machine(kSource / "mbs/bucyrus495.yaml");
  change(m);
  return geometry_faults(m, m.dipper.base_rake);
}

TEST(MachineGeometry, OfEveryMachineThatComesAlongCloses) {
  int machines = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "mbs")) {
    if (file.path().extension() != ".yaml") continue;
    const MachineData m = load_machine(file.path());
    EXPECT_THAT(geometry_faults(m, m.dipper.base_rake), IsEmpty()) << file.path();
    ++machines;
  }
  EXPECT_GE(machines, 2);
}

/// 61.8 degrees and the effect rake_offset, up to 6 either way; the paper's studies are within it.
TEST(MachineGeometry, The495FitsTogetherAtEveryRakeOfAnEffect) {
  const MachineData m = load_machine(kSource / "mbs/bucyrus495.yaml");
  for (double rake_deg = 55.8; rake_deg < 68; rake_deg += 1)
    EXPECT_THAT(geometry_faults(m, radians(rake_deg)), IsEmpty()) << rake_deg;
}

TEST(MachineGeometry, RopesThatDoNotReachAreReportedWithTheLength) {
  EXPECT_THAT(faults_of_495([](MachineData& m) { m.rope.length_at_zero_hoist = 20; }),
              ElementsAre(AllOf(HasSubstr("length_at_zero_hoist, 20.00 m, is too short"),
                                HasSubstr("-12.00 and 0.50 m"))));
  EXPECT_THAT(faults_of_495([](MachineData& m) { m.rope.length_at_zero_hoist = 60; }),
              ElementsAre(HasSubstr("is too long")));
}

TEST(MachineGeometry, ABoomInTheWayIsReported) {
  EXPECT_THAT(faults_of_495([](MachineData& m) {
                m.boom.point = {17.5, 0, 10.8};
              }),
              ElementsAre(testing::AnyOf(HasSubstr("within its radius of 1.20 m"),
                                         HasSubstr("hoisting lowers the dipper"))));
  EXPECT_THAT(faults_of_495([](MachineData& m) { m.limits.saddle_max = 1.5; }),
              ElementsAre(HasSubstr("hoisting lowers the dipper")));
  EXPECT_THAT(faults_of_495([](MachineData& m) { m.rope.drum = m.boom.point; }),
              ElementsAre(HasSubstr("rope.drum is 0.00 m from the sheave's axis")));
}

TEST(MachineGeometry, LimitsAndInertiasThatNoMachineHasAreReportedTogether) {
  EXPECT_THAT(faults_of_495([](MachineData& m) {
                m.limits.crowd_min = 4;
                m.door.inertia = {1e4, 1e3, 1e3};
              }),
              ElementsAre(HasSubstr("limits.crowd_min is 4, not below"),
                          HasSubstr("door.inertia is [1e+04, 1000, 1000]")));
}

}  // namespace
}  // namespace dipper::machine
