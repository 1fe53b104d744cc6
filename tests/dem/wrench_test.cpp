// The returned wrenches against LIGGGHTS's own list of contacts, step by step, and the rock's
// angular momentum against both.
//
// Tangential damping is off here: LIGGGHTS damps a contact that sticks and not one that slides, and
// its per-contact output evaluates the law a second time, when a sliding contact's displacement has
// just been cut back to the limit: rounding then says whether it sticks. balance_test.cpp has it
// on.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dem/contact_list.hpp"
#include "tests/dem/drum.hpp"
#include "tests/dem/momentum.hpp"

namespace dipper::dem {
namespace {

using test::Contact;

/// Sums over ranks. Collective.
Wrench all_ranks(Wrench F) {
  MPI_Allreduce(MPI_IN_PLACE, F.torque.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, F.force.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return F;
}

/// What the contacts do to mesh `body`, about its origin: minus the force on each sphere.
Wrench on_body(const std::vector<Contact>& contacts, int body, const Vector3d& p_WBo) {
  Wrench F;
  for (const Contact& c : contacts) {
    if (c.mesh != body) continue;
    F.force -= c.force;
    F.torque -= (c.point - p_WBo).cross(c.force);
  }
  return all_ranks(F);
}

/// What the contacts do to the rock, about W's origin, couples on the spheres included.
Wrench on_rock(const std::vector<Contact>& contacts) {
  Wrench F;
  for (const Contact& c : contacts) {
    F.force += c.force;
    F.torque += c.centre.cross(c.force) + c.torque;
  }
  return all_ranks(F);
}

/// The largest relative error seen. Forces are relative to at least the weight of a sphere, 100 N;
/// torques to that at 1 m, the arm of the drum.
struct Worst {
  double force = 0, torque = 0;
  void add(const Wrench& is, const Wrench& should) {
    constexpr double floor = 100;
    force =
        std::max(force, (is.force - should.force).norm() / std::max(should.force.norm(), floor));
    torque = std::max(torque, (is.torque - should.torque).norm() /
                                  std::max({should.torque.norm(), should.force.norm(), floor}));
  }
};

class WrenchOn : public testing::TestWithParam<const char*> {
 protected:
  test::Drum drum_{GetParam(), {{"gammat", "0"}}};
  LiggghtsRock& rock_ = drum_.rock();
  test::ContactList* list_ = test::ContactList::attach(rock_.liggghts(), "contacts");
};

TEST_P(WrenchOn, EachBodyIsTheSumOverItsContacts) {
  const double dt = drum_.timestep();
  rock_.place(test::Drum::poses(0));
  std::vector<Pose> from = test::Drum::poses(0);
  std::vector<Wrench> last(2);
  Worst end, mean;
  int loaded[2] = {}, here = 0;
  std::int64_t step = 0;
  const auto run = [&](int steps) {
    step += steps;
    const std::vector<Pose> to = test::Drum::poses(static_cast<double>(step) * dt);
    const core::RockState state = rock_.step({steps, to});
    ASSERT_EQ(list_->steps.size(), steps);
    for (int b = 0; b < 2; ++b) {
      // The trapezoid over the window, each step about where the origin then was.
      Wrench sum = 0.5 * last[b];
      for (int i = 1; i <= steps; ++i) {
        const Vector3d p_WBo = from[b].p + (to[b].p - from[b].p) * i / steps;
        last[b] = on_body(list_->steps[i - 1], b, p_WBo);
        sum = sum + (i < steps ? 1.0 : 0.5) * last[b];
      }
      end.add(state.bodies[b].end, last[b]);
      mean.add(state.bodies[b].mean, (1.0 / steps) * sum);
      loaded[b] += last[b].force.norm() > 0;
    }
    from = to;
    here += !list_->steps.back().empty();
    list_->steps.clear();
  };
  constexpr int windows = 800;
  for (int k = 0; k < windows; ++k) run(k % 4 == 0 ? 1 : k % 23 + 1);
  MPI_Allreduce(MPI_IN_PLACE, &here, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  EXPECT_GT(here, windows / 4) << "windows in which every rank had contacts";
  if (test::rank() == 0) {
    fmt::print(
        "{}: end off by {:.2e} force {:.2e} torque, mean by {:.2e} {:.2e}; {} and {} of {} "
        "windows loaded\n",
        GetParam(), end.force, end.torque, mean.force, mean.torque, loaded[0], loaded[1], windows);
  }
  EXPECT_GT(loaded[0], windows / 2);
  EXPECT_GT(loaded[1], windows / 4);
  for (const Worst& w : {end, mean}) {
    EXPECT_LT(w.force, 1e-8);  // the requirement
    EXPECT_LT(w.torque, 1e-8);
    EXPECT_LT(w.force, 1e-11);  // the regression
    EXPECT_LT(w.torque, 1e-11);
  }
}

// Velocity Verlet keeps angular momentum as it keeps momentum: with a step's x1 = x0 + dt v,
// x1 x m v1 - x0 x m v0 = dt/2 (x0 x f0 + x1 x f1) exactly, and spin takes the same halves of the
// torques. LIGGGHTS's spheres receive from a wall, besides the contact force, two couples that its
// wall torque leaves out: rolling friction, and the tangential force's at half the overlap (its arm
// to the sphere is R - delta/2, the contact point is at R - delta). With them the balance closes;
// the returned torque is the moment of the contact forces, and lacks them.
TEST_P(WrenchOn, BodiesAndCouplesBalanceTheAngularMomentumOfTheRock) {
  const double dt = drum_.timestep();
  const Vector3d gravity(0, 0, -9.81);
  rock_.place(test::Drum::poses(0));
  rock_.step({1, test::Drum::poses(dt)});  // inserts the rock
  list_->steps.clear();
  test::Momentum before = test::momentum(rock_.liggghts());
  Wrench rock_before, bodies_before;  // about W's origin, by the contacts and as returned
  double worst = 0, couples = 0;
  constexpr int steps = 6000;
  for (int k = 2; k <= steps; ++k) {
    const core::RockState state = rock_.step({1, test::Drum::poses(k * dt)});
    const test::Momentum after = test::momentum(rock_.liggghts());
    const Wrench rock = on_rock(list_->steps.back());
    list_->steps.clear();
    Wrench bodies;
    for (const core::BodyLoad& b : state.bodies) bodies = bodies + shift(b.end, -b.X_WB.p);

    const Vector3d weight = 0.5 * (before.moment + after.moment).cross(gravity);
    const Vector3d received = (after.angular - before.angular) / dt - weight;
    const Vector3d listed = 0.5 * (rock_before.torque + rock.torque);
    const Vector3d returned = -0.5 * (bodies_before.torque + bodies.torque);
    // Relative to at least the torque of the rock's weight at 1 m.
    const double scale = std::max(listed.norm(), after.mass * gravity.norm());
    worst = std::max(worst, (received - listed).norm() / scale);
    couples = std::max(couples, (returned - listed).norm() / scale);
    before = after;
    rock_before = rock;
    bodies_before = bodies;
  }
  if (test::rank() == 0) {
    fmt::print("{}: angular momentum off by {:.2e}; couples are up to {:.2e} of the torque\n",
               GetParam(), worst, couples);
  }
  EXPECT_LT(worst, 1e-8);
  EXPECT_LT(couples, 0.1);  // 0.1 R of rolling friction and some 0.01 R of overlap, at arms of 1 m
}

INSTANTIATE_TEST_SUITE_P(Rock, WrenchOn, testing::Values("spheres", "multispheres"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace dipper::dem
