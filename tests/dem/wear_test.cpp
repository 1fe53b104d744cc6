// Pressure and Finnie wear on a mesh that WallMotion moves. A plate hits a sphere at rest without
// friction: with u the normal and t the tangential velocity, LIGGGHTS wears by
//
//   dV = 2 k |F| f |v| dt,  f = sin 2g - 3 sin^2 g  (3 tan g < 1; g the angle of incidence),
//
// while the two approach (Finnie 1960, Wear 3:87, as a rate). There |F| dt = -m du, so
// V = 2 k m times the integral over u, 0 ... n, of (2 u t - 3 u^2)/sqrt(u^2 + t^2).
#include <container.h>
#include <fix_mesh_surface.h>
#include <gtest/gtest.h>
#include <modify.h>
#include <tri_mesh.h>

#include <cmath>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

/// Sum over the plate's triangles of a property times their area. Collective.
double integral(LiggghtsRock& rock, const char* property) {
  auto* plate =
      static_cast<LAMMPS_NS::FixMeshSurface*>(rock.liggghts().modify->find_fix_id("plate"));
  LAMMPS_NS::TriMesh* mesh = plate->triMesh();
  auto* values = mesh->prop().getElementProperty<LAMMPS_NS::ScalarContainer<double>>(property);
  double sum = 0;
  for (int i = 0; i < mesh->sizeLocal(); ++i) sum += values->get(i) * mesh->areaElem(i);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

TEST(Wear, OfASlantedImpactIsFinniesAndPressureIsTheForce) {
  const test::Scene scene("wear");
  setup::RockSetup s = scene.setup("wear.in");
  s.bodies = {"plate"};
  s.variables.push_back(
      {"plate", scene.stl("plate", test::box(Vector3d(-1, -1, -0.2), Vector3d(1, 1, 0)))});
  LiggghtsRock rock(s, MPI_COMM_WORLD);
  rock.place({Pose{}});
  const double n = 0.3, t = 2.0, dt = rock.info().timestep_s;
  double largest = 0;
  for (int window = 1; window <= 300; ++window) {
    const double time = 20 * window * dt;
    const core::RockState state =
        rock.step({20, {Pose{Quaterniond::Identity(), {t * time, 0, n * time}}}});
    const double pressed = integral(rock, "sigma_n"), force = state.bodies[0].end.force.z();
    ASSERT_NEAR(pressed, -force, 1e-9 * std::abs(force)) << "step " << state.step;
    largest = std::max(largest, pressed);
  }
  // The contact is over: F_max = n sqrt(k m), and nothing wears any more.
  const double m = 2500 * 4.0 / 3 * M_PI * 1e-3;
  EXPECT_NEAR(largest, n * std::sqrt(1e7 * m), 2e-3 * largest);
  EXPECT_EQ(integral(rock, "sigma_n"), 0);
  const double v = std::hypot(n, t);
  const double by_u = 2 * t * (v - t) - 3 * (n * v / 2 - t * t / 2 * std::asinh(n / t));
  const double worn = integral(rock, "wear");
  EXPECT_NEAR(worn, 2 * 1e-9 * m * by_u, 2e-3 * worn);
}

}  // namespace
}  // namespace dipper::dem
