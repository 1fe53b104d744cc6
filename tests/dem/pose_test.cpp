// The walls are where they were sent: 10,000 windows of pitch, swing and travel at once,
// with no machine in the loop.
#include <fix_mesh_surface.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lammps.h>
#include <modify.h>
#include <tri_mesh.h>

#include <algorithm>
#include <cmath>

#include "dem/liggghts_rock.hpp"
#include "tests/dem/scene.hpp"

namespace dipper::dem {
namespace {

using Eigen::AngleAxisd;

constexpr int windows = 10000;
constexpr int steps = 3;

/// A shovel's motion: the house travels and swings, the body pitches `radius` from the swing axis.
Pose pose(double t, double radius, double pitch, double phase) {
  const Vector3d p_WH(1.5 * std::sin(0.4 * t), -0.5 * std::sin(0.3 * t), 0);
  const Quaterniond R_WH(AngleAxisd(0.9 * std::sin(0.5 * t), Vector3d::UnitZ()));
  const Quaterniond R_HB(AngleAxisd(pitch * std::sin(1.3 * t + phase), Vector3d::UnitY()));
  const Vector3d p_HB(radius, 0, 7 + 3 * std::sin(0.7 * t + phase));
  return {R_WH * R_HB, p_WH + R_WH * p_HB};
}

std::vector<Pose> poses(double t) { return {pose(t, 20, 1.2, 0), pose(t, 21, -2.5, 0.8)}; }

LAMMPS_NS::TriMesh* wall_of(LAMMPS_NS::LAMMPS& lmp, const std::string& body) {
  auto* fix = lmp.modify->find_fix_id(body.c_str());
  return dynamic_cast<LAMMPS_NS::FixMeshSurface*>(fix)->triMesh();
}

/// The farthest that a node of the wall is from where X_WB takes the STL file's [m]. Collective.
double worst_node(LAMMPS_NS::LAMMPS& lmp, const std::string& body, const mesh::TriangleMesh& box,
                  const Pose& X_WB) {
  LAMMPS_NS::TriMesh* wall = wall_of(lmp, body);
  double worst = 0;
  int triangles = wall->sizeLocal();
  for (int i = 0; i < wall->sizeLocal(); ++i) {
    for (int j = 0; j < 3; ++j) {
      Vector3d p_W;
      wall->node_slow(i, j, p_W.data());
      const Vector3d& p_B = box.vertices[box.triangles[wall->id_slow(i)][j]];
      worst = std::max(worst, (p_W - X_WB * p_B).norm());
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  MPI_Allreduce(MPI_IN_PLACE, &triangles, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(triangles, 12) << "of " << body << " on all ranks";
  return worst;
}

TEST(Pose, EndsEachOf10000WindowsWhereItWasCommandedAndDoesNotDrift) {
  const test::Scene scene("pose");
  const mesh::TriangleMesh boxes[] = {
      test::box(Vector3d(-2, -2, -1.5), Vector3d(2, 2, 1.5)),
      test::box(Vector3d(-0.1, -1.8, -2.8), Vector3d(0.1, 1.8, 0.2))};
  setup::RockSetup setup = scene.setup("pose.in");
  setup.bodies = {"dipper", "door"};
  setup.variables.insert(setup.variables.end(), {{"dipper", scene.stl("dipper", boxes[0])},
                                                 {"door", scene.stl("door", boxes[1])}});
  LiggghtsRock rock(setup, MPI_COMM_WORLD);
  const double window = steps * rock.info().timestep_s;
  rock.place(poses(0));

  PoseDistance worst[2] = {}, first[2] = {}, last[2] = {};
  const auto raise = [](PoseDistance& to, const PoseDistance& d) {
    to = {std::max(to.metres, d.metres), std::max(to.radians, d.radians)};
  };
  for (int k = 1; k <= windows; ++k) {
    const auto commanded = poses(k * window);
    const core::RockState state = rock.step({steps, commanded});
    ASSERT_EQ(state.step, k * steps);
    for (int b = 0; b < 2; ++b) {
      const PoseDistance d = distance(state.bodies[b].X_WB, commanded[b]);
      raise(worst[b], d);
      if (k <= windows / 10) raise(first[b], d);
      if (k > windows - windows / 10) raise(last[b], d);
    }
  }
  for (int b = 0; b < 2; ++b) {
    SCOPED_TRACE(setup.bodies[b]);
    const double node =
        worst_node(rock.liggghts(), setup.bodies[b], boxes[b], poses(windows * window)[b]);
    if (test::rank() == 0) {
      fmt::print(
          "{}: worst {:.2e} m {:.2e} rad, first tenth {:.2e} {:.2e}, last {:.2e} {:.2e}; "
          "nodes {:.2e} m\n",
          setup.bodies[b], worst[b].metres, worst[b].radians, first[b].metres, first[b].radians,
          last[b].metres, last[b].radians, node);
    }
    EXPECT_LT(worst[b].metres, 1e-6);  // the requirement
    EXPECT_LT(worst[b].radians, 1e-6);
    EXPECT_LT(worst[b].metres, 1e-12);  // the regression: rounding, at 20 m
    EXPECT_LT(worst[b].radians, 1e-12);
    EXPECT_LT(node, 1e-10);                          // 30,000 turns left the body's shape alone
    EXPECT_LE(last[b].metres, 3 * first[b].metres);  // no drift
    EXPECT_LE(last[b].radians, 3 * first[b].radians);
  }

  // What pushes a wall aside is seen in the nodes, and taken out by the next window.
  const double aside[] = {0.01, 0.02, -0.03};
  for (const auto& body : setup.bodies) wall_of(rock.liggghts(), body)->move(aside);
  const auto commanded = poses((windows + 1) * window);
  const core::RockState state = rock.step({steps, commanded});
  for (int b = 0; b < 2; ++b) {
    EXPECT_LT(distance(state.bodies[b].X_WB, commanded[b]).metres, 1e-12);
    EXPECT_LT(worst_node(rock.liggghts(), setup.bodies[b], boxes[b], commanded[b]), 1e-10);
  }
}

}  // namespace
}  // namespace dipper::dem
