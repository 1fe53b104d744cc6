// How far down the dipper comes, over ground with and without rock on it.
#include "machine/approach.hpp"

#include <gtest/gtest.h>

#include "common/angles.hpp"
#include "machine/machine_data.hpp"
#include "tests/places.hpp"

namespace dipper::machine {
namespace {

class Approach : public testing::Test {
 protected:
  MachineData data = load_machine(test::source() / "mbs/bucyrus495.yaml");
  ShovelKinematics shovel{data, Pose{}, radians(61.8)};
  TeethPath way = {{13.1, 4.4}, {13.1, 0.4}};
  HeightMap face{{6, -6, 0.2, 80, 60}};

  Vector2d end(const Pose& X_WBoom = Pose{}) const {
    return approach_end(way, face, X_WBoom, 2, shovel);
  }
  /// Rock of a width about y, one cell long.
  void put(double x, double y, double z, double width = 1.6) {
    for (double at = y - width / 2 + 0.1; at < y + width / 2; at += 0.2)
      face.at(static_cast<int>((x - 6) / 0.2), static_cast<int>((at + 6) / 0.2)) = z;
  }
};

TEST_F(Approach, GoesDownWhereThereIsNoRock) {
  EXPECT_LT((end() - way.back()).norm(), 1e-9);
  put(13.1, 3, 5);       // beside the dipper
  put(14, 0, 5);         // in front of it
  put(13.1, 0, 5, 0.8);  // a rock, which is pushed aside
  EXPECT_LT((end() - way.back()).norm(), 1e-9);
}

TEST_F(Approach, StopsAboveWhatLiesUnderTheTeethOrTheHeel) {
  put(13.05, 1, 1.2);
  EXPECT_NEAR(end().y(), 1.2 + kApproachClear_m, 0.12);
  face = HeightMap{face.grid()};
  const double heel_x = shovel.heel(way.back()).x();
  for (double x = heel_x - 1; x < heel_x + 1; x += 0.2) put(x, -1, 2.1);
  const Vector2d heel = shovel.heel(end());
  EXPECT_GE(heel.y(), 2.1 + kApproachClear_m - 1e-9);
  EXPECT_LT(heel.y(), 2.1 + kApproachClear_m + 0.4);
}

TEST_F(Approach, LooksAlongTheBoom) {
  for (double x = 12.3; x < 13.5; x += 0.2) put(x, 13.1 * std::sin(0.2), 1.2, 2.4);
  Pose X_WBoom;
  X_WBoom.R = from_rotation_vector({0, 0, 0.2});
  EXPECT_GT(end(X_WBoom).y(), 1.3);
  X_WBoom.R = from_rotation_vector({0, 0, -0.4});
  EXPECT_NEAR(end(X_WBoom).y(), 0.4, 1e-9);
}

TEST_F(Approach, IsRefusedWhereEvenTheBeginIsNotFree) {
  put(13.05, 0, 6);
  EXPECT_THROW(end(), std::domain_error);
}

}  // namespace
}  // namespace dipper::machine
