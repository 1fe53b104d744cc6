// Moves one LIGGGHTS wall mesh as a rigid body and sums the rock's force on it.
#pragma once

#include <fix.h>

#include <array>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"
#include "coupler/core/server.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "dem/bytes.hpp"

namespace LAMMPS_NS {
class FixMeshSurface;
class TriMesh;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// A LIGGGHTS fix, put behind every fix of the deck so that it sees the step's final wall force.
///
/// LIGGGHTS's own `fix move/mesh` has one axis fixed in space and one velocity per mover; a dipper
/// pitches about an axis that itself swings. Here the mesh turns about the body's own origin by the
/// exact increment of the window's twist, once a step, so general motion needs no correction
/// within a window. All methods are collective over the world communicator.
class WallMotion : public LAMMPS_NS::Fix {
 public:
  /// Takes over the mesh/surface/stress fix `mesh_id`, whose nodes are still in the body frame
  /// and whose reference point is the body's origin. Throws std::runtime_error if there is none.
  static WallMotion* attach(LAMMPS_NS::LAMMPS* lmp, const std::string& mesh_id);

  WallMotion(LAMMPS_NS::LAMMPS* lmp, int narg, char** arg);

  /// Puts the mesh at X_WB; before the first step only.
  void place(const Pose& X_WB);

  /// Instead of `place`, after a restart that brought the mesh back at X_WB.
  void adopt(const Pose& X_WB, const setup::WallMemory& remembered);

  /// From the next step on: moves at constant twist to reach X_WB_target after n_steps.
  void begin_window(const Pose& X_WB_target, long n_steps);

  /// The mesh's extent, in the body frame.
  Box box() const;

  /// The mesh at its present pose, in W.
  mesh::TriangleMesh in_world() const;

  /// The window's mean and last wrench, and the pose read back from the mesh nodes.
  core::BodyLoad end_window();

  /// Its state for a checkpoint besides setup::WallMemory, and the restoring of it, after `adopt`.
  void save(ByteWriter& out) const;
  void load(ByteReader& in);

  // Called by LIGGGHTS.
  int setmask() override;
  void setup_pre_force(int vflag) override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;

 private:
  Pose pose_from_nodes() const;
  /// Turns the mesh about the point Q by a rotation vector in world axes.
  void turn(const Vector3d& rotation, const Vector3d& p_WQ);
  void impose_velocity();

  LAMMPS_NS::FixMeshSurface* wall_ = nullptr;
  LAMMPS_NS::TriMesh* mesh_ = nullptr;
  /// Body-frame nodes of every element, by element id: the reference for the pose read back.
  std::vector<std::array<Vector3d, 3>> reference_;
  Pose X_WB_;
  Twist V_WB_W_;
  Wrench sum_, last_;
  long steps_ = 0;
};

}  // namespace dipper::dem
