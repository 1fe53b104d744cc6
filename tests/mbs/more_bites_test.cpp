#include "mbs/more_bites.hpp"

#include <gtest/gtest.h>

namespace dipper::mbs {
namespace {

/// Above the face after a bite from 5 to 12 s of the motion, half full.
class MoreBites : public testing::Test {
 protected:
  MoreBites() {
    bites.begun = 1;
    bites.from_s = 5;
    out.path_s = 12;
    out.at_face = out.weighs_true = true;
    out.handle_rise = -0.4;
    out.load_kg = 40e3;
    out.full_kg = 80e3;
  }

  Bites bites;
  BiteSight out;
};

TEST_F(MoreBites, TheFirstBeginsWhereTheTeethMeetRockWithTheHandleUpEnough) {
  BiteSight in = out;
  in.meets = true;
  in.handle_rise = -0.8;
  EXPECT_EQ(Bites{}.next(in).begun, 0);
  in.handle_rise = -0.7;
  EXPECT_EQ(Bites{}.next(in).begun, 1);
  EXPECT_EQ(Bites{}.next(in).from_s, 12);
}

TEST_F(MoreBites, ALightDipperOutOfTheFaceGoesBackInAndDigsAgain) {
  Bites b = bites.next(out);
  EXPECT_EQ(b.phase, Bites::goes_back);
  EXPECT_EQ(b.brought, 40e3);
  out.path_s = 5.1;
  EXPECT_EQ(b.next(out).phase, Bites::goes_back);
  out.path_s = 5;
  b = b.next(out);
  EXPECT_EQ(b.phase, Bites::goes_in);
  EXPECT_EQ(b.begun, 2);
  EXPECT_EQ(b.next(out).phase, Bites::goes_in);
  BiteSight held = out, free = out;
  held.overload = 0.95;
  EXPECT_EQ(b.next(held).phase, Bites::digs);
  free.relief_m = -1.25;
  EXPECT_EQ(b.next(free).phase, Bites::digs) << "as deep as this bite may go";
}

TEST_F(MoreBites, ADipperThatIsCaughtOnItsWayBackDigsFromThere) {
  bites.phase = Bites::goes_back;
  out.caught = true;
  EXPECT_EQ(bites.next(out).phase, Bites::goes_in);
}

TEST_F(MoreBites, NoneForADipperThatIsFullOrInRockOrNotWeighed) {
  BiteSight full = out, in_rock = out, shaken = out, early = out;
  full.load_kg = 0.96 * 80e3;
  in_rock.meets = true;
  shaken.weighs_true = false;
  early.path_s = 7.9;
  for (const BiteSight& s : {full, in_rock, shaken, early})
    EXPECT_EQ(bites.next(s).phase, Bites::digs);
}

TEST_F(MoreBites, NoMoreThanThreeAndNoneAfterOneThatBroughtLittle) {
  bites.begun = 3;
  EXPECT_EQ(bites.next(out).phase, Bites::digs);
  bites.begun = 2;
  bites.brought = 37e3;
  EXPECT_EQ(bites.next(out).phase, Bites::digs);
  bites.brought = 35e3;
  EXPECT_EQ(bites.next(out).phase, Bites::goes_back);
}

TEST_F(MoreBites, TheNextDigBeginsAnew) {
  out.at_face = false;
  EXPECT_EQ(bites.next(out).begun, 0);
}

}  // namespace
}  // namespace dipper::mbs
