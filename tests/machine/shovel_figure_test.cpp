#include "machine/shovel_figure.hpp"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "common/mesh/mesh_check.hpp"
#include "machine/kinematics.hpp"
#include "machine/truck_figure.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

const std::filesystem::path kSource = test::source();

std::map<std::string, Box> boxes(const std::vector<FigurePart>& parts) {
  std::map<std::string, Box> all;
  for (const FigurePart& part : parts) {
    const auto faults = mesh::check_mesh(part.mesh);
    EXPECT_TRUE(faults.empty()) << part.name << ": " << faults[0].message;
    all[part.name] = mesh::bounding_box(part.mesh);
  }
  return all;
}

/// The same machine at another size.
MachineData scaled(MachineData m, double by) {
  for (Vector3d* p : {&m.boom.point, &m.saddle.position, &m.dipper.inside, &m.dipper.handle_end,
                      &m.dipper.bail, &m.rope.drum})
    *p *= by;
  for (double* length : {&m.boom.sheave_radius, &m.handle.reach_at_zero_crowd,
                         &m.handle.mass_center, &m.limits.crowd_max})
    *length *= by;
  return m;
}

class Figure : public testing::Test {
 protected:
  const MachineData machine = load_machine(kSource / "mbs/bucyrus495.yaml");
};

TEST_F(Figure, StandsOnTheGroundAndHasThePointsOfTheData) {
  const ShovelFigure figure = shovel_figure(machine);
  auto ground = boxes(figure.ground), house = boxes(figure.house);
  EXPECT_NEAR(ground["crawlers"].min_m.z(), 0, 1e-12);
  const Box sheaves = house["sheaves"];
  const Vector3d middle = 0.5 * (sheaves.min_m + sheaves.max_m);
  EXPECT_NEAR((middle - machine.boom.point).norm(), 0, 1e-9);
  EXPECT_GT(sheaves.sides_m().z() / 2, machine.boom.sheave_radius);
  EXPECT_LT(sheaves.sides_m().z() / 2, 1.2 * machine.boom.sheave_radius);
  EXPECT_TRUE(house["boom"].holds(machine.saddle.position));
  EXPECT_TRUE(house["house"].holds(machine.rope.drum - Vector3d(0, 0, 0.1)));
  EXPECT_TRUE(boxes(figure.saddle)["saddle"].holds({0, 0, 0}));
  EXPECT_TRUE(boxes(figure.dipper)["bail"].holds(machine.dipper.bail));
  EXPECT_TRUE(boxes(figure.dipper)["lugs"].holds(machine.dipper.handle_end));
}

TEST_F(Figure, TheHandleIsInTheSaddleAtEveryCrowd) {
  const Box handle = boxes(shovel_figure(machine).handle)["handle"];
  for (const double crowd : {machine.limits.crowd_min, machine.limits.crowd_max})
    EXPECT_TRUE(handle.holds({-(machine.handle.reach_at_zero_crowd + crowd), 0, 0}));
}

TEST_F(Figure, GrowsWithTheMachine) {
  const ShovelFigure whole = shovel_figure(machine), half = shovel_figure(scaled(machine, 0.5));
  ASSERT_EQ(whole.house.size(), half.house.size());
  for (std::size_t k = 0; k < whole.house.size(); ++k)
    for (std::size_t v = 0; v < whole.house[k].mesh.vertices.size(); ++v)
      EXPECT_NEAR((half.house[k].mesh.vertices[v] - 0.5 * whole.house[k].mesh.vertices[v]).norm(),
                  0, 1e-9);
  MachineData flat = machine;
  flat.boom.point.z() = flat.saddle.position.z();
  EXPECT_THROW(shovel_figure(flat), std::invalid_argument);
}

TEST_F(Figure, ItsRopeIsAsLongAsTheKinematicsHasIt) {
  const ShovelKinematics shovel(machine, Pose{}, machine.dipper.base_rake);
  const Drives drives{-5, 1, 0, 0};
  const ShovelPose pose = shovel.pose(drives);
  for (const double side : {1.0, -1.0}) {
    Vector3d pin = machine.dipper.bail;
    pin.y() *= side;
    const auto way = rope_way(machine, side, pose.X_WB * pin);
    double length = 0;
    for (std::size_t k = 1; k < way.size(); ++k) length += (way[k] - way[k - 1]).norm();
    // The arc is drawn as chords.
    EXPECT_NEAR(length, shovel.rope_path(pose.saddle, drives.crowd), 0.01);
    EXPECT_EQ(way.back(), pose.X_WB * pin);
    EXPECT_EQ(way.front().y(), side * machine.rope.drum.y());
  }
}

TEST(TruckFigure, StandsOnTheGroundAndLeavesTheBedOpen) {
  const Box bed{{-3.7, -3.45, 0.8}, {3.7, 3.45, 6.5}};
  auto parts = boxes(truck_figure(bed));
  EXPECT_NEAR(parts["tyres"].min_m.z(), 0, 1e-9);
  for (const auto& [name, box] : parts) {
    // Nothing above the bed's floor between its walls.
    EXPECT_FALSE(box.holds({0, 0, 5})) << name;
    EXPECT_LT(box.max_m.y(), 1.25 * bed.max_m.y()) << name;
  }
}

}  // namespace
}  // namespace dipper::machine
