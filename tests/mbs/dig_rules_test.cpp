#include "mbs/dig_rules.hpp"

#include <gtest/gtest.h>

namespace dipper::mbs {
namespace {

/// In the upper half of the face, the teeth in rock, half full.
class DigRules : public testing::Test {
 protected:
  DigRules() {
    feel.at_face = true;
    feel.load_kg = 40e3;
    feel.resistance_N = 1e6;
    feel.handle_rise = -0.5;
    feel.overload = 0.8;
    feel.room_m = 1;
  }
  DigWish wish() const { return dig_wish(feel, limits); }
  bool as_the_motion_says() const {
    const DigWish w = wish();
    return w.rate == 1 && !w.crowd_back && !w.lift;
  }

  DigFeel feel;
  DigLimits limits{80e3, 3e6};
};

TEST_F(DigRules, ALightDipperGoesDeeper) {
  EXPECT_EQ(wish().crowd_back, -0.2);
  EXPECT_FALSE(wish().lift);
  EXPECT_EQ(wish().rate, 1);
  feel.load_kg = 0.9 * 80e3;
  EXPECT_TRUE(as_the_motion_says()) << "as good as full";
}

TEST_F(DigRules, NotDeeperWhereThatIsDownNorWithoutRockRoomOrForce) {
  const DigFeel light = feel;
  feel.handle_rise = -0.75;
  EXPECT_TRUE(as_the_motion_says()) << "into the ground";
  feel = light;
  feel.resistance_N = 0.14e6;
  EXPECT_TRUE(as_the_motion_says()) << "the face has ended";
  feel = light;
  feel.room_m = 0.1;
  EXPECT_TRUE(as_the_motion_says()) << "the crowd is all out";
}

TEST_F(DigRules, TheCrowdIsHeldAtNineTenthsOfItsForceInRockFullOrNot) {
  feel.handle_rise = -0.9;
  for (const double load_kg : {40e3, 75e3}) {
    feel.load_kg = load_kg;
    for (const auto& [overload, back] : {std::pair{1.0, 0.25}, {1.05, 0.375}, {2.0, 0.5}}) {
      feel.overload = overload;
      EXPECT_NEAR(wish().crowd_back.value(), back, 1e-12);
    }
  }
  feel.load_kg = 80e3;
  feel.overload = 1.05;
  EXPECT_NEAR(wish().crowd_back.value(), 0.375, 1e-12) << "more than breaking out asks for";
  feel.overload = 0.95;
  EXPECT_EQ(wish().crowd_back, 0.3);
}

/// On its way down to the face.
TEST_F(DigRules, ADipperThatHasLandedKeepsItsRopesUntilTheMotionDrawsThemIn) {
  feel.pays_out = 0.4;
  feel.carried = 0.3;
  EXPECT_TRUE(is_landed(false, feel));
  feel.carried = 0.9;
  EXPECT_FALSE(is_landed(false, feel)) << "it hangs";
  EXPECT_TRUE(is_landed(true, feel)) << "for a moment";
  feel.landed = true;
  EXPECT_EQ(wish().lift, 0.4) << "the rope stands";
  feel.pays_out = 0;
  EXPECT_EQ(wish().lift, 0.0);
  EXPECT_FALSE(wish().crowd_back);
  feel.carried = 0.3;
  EXPECT_EQ(wish().lift, 0.3) << "it lies";
  EXPECT_FALSE(is_landed(false, feel)) << "caught in the dig";
  feel.pays_out = -0.2;
  EXPECT_FALSE(is_landed(true, feel)) << "the dig rises";
}

TEST_F(DigRules, AStallingCrowdLetsTheTeethRiseWhereTheHoistHasForceToSpare) {
  feel.overload = 1.0;
  EXPECT_NEAR(wish().lift.value(), 0.8 * 0.25, 1e-12);
  feel.hoist_overload = 0.95;
  EXPECT_FALSE(wish().lift);
  feel.hoist_overload = 0;
  feel.overload = 0.85;
  EXPECT_FALSE(wish().lift);
}

TEST_F(DigRules, ACrowdBehindThePathGoesOutBeforeTheDigContinues) {
  feel.behind_m = 0.5;
  feel.handle_rise = -0.9;  // the path is above the ground
  feel.resistance_N = 0;
  EXPECT_NEAR(wish().crowd_back.value(), -0.25, 1e-12);
  EXPECT_EQ(wish().rate, 0.25);
  feel.overload = 0.5;
  EXPECT_EQ(wish().crowd_back, -0.5);
  feel.load_kg = 0.9 * 80e3;
  EXPECT_TRUE(as_the_motion_says());
  feel.load_kg = 40e3;
  feel.behind_m = 0.05;
  EXPECT_TRUE(as_the_motion_says());
}

TEST_F(DigRules, NearItsForceTheCrowdGoesOutMoreSlowly) {
  feel.overload = 0.88;
  EXPECT_NEAR(wish().crowd_back.value(), -0.05, 1e-12);
}

TEST_F(DigRules, AFullDipperBreaksOutUntilTheTeethAreFree) {
  feel.load_kg = 80e3;
  EXPECT_EQ(wish().crowd_back, 0.3);
  feel.resistance_N = 0;
  EXPECT_EQ(wish().crowd_back, 0.0) << "and does not go in again";
}

TEST_F(DigRules, ACaughtDipperIsLiftedAndDrawnBackInPlaceOfPushedOn) {
  feel.carried = 0.49;
  EXPECT_EQ(wish().crowd_back, 0.3);
  EXPECT_EQ(wish().lift, 0.3);
  EXPECT_EQ(wish().rate, 0.25);
  feel.carried = 0.5;
  EXPECT_FALSE(wish().lift);
}

TEST_F(DigRules, ADipperThatComesDownOnRockIsHeldThereUntilTheDigBegins) {
  feel.carried = 0.49;
  feel.pays_out = 0.8;
  EXPECT_EQ(wish().crowd_back, 0.3);
  EXPECT_NEAR(wish().lift.value(), 0.8 + 0.3, 1e-12) << "0.3 m/s more than the motion pays out";
  EXPECT_EQ(wish().rate, 1) << "the rest of the way down takes no longer";
}

TEST_F(DigRules, NothingWhileTheHouseTurnsTheDoorOpensOrTheDipperComesDown) {
  feel.pays_out = 0.8;
  EXPECT_TRUE(as_the_motion_says());
  feel.pays_out = 0;
  feel.at_face = false;
  feel.carried = 0;
  EXPECT_TRUE(as_the_motion_says());
}

}  // namespace
}  // namespace dipper::mbs
