#include "dem/wall_motion.hpp"

#include <fix_mesh_surface.h>
#include <memory.h>
#include <modify.h>
#include <mpi.h>
#include <tri_mesh.h>
#include <update.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "dem/own_fix.hpp"

namespace dipper::dem {

using LAMMPS_NS::FixMeshSurface;
using NodeVelocity = LAMMPS_NS::MultiVectorContainer<double, 3, 3>;

WallMotion* WallMotion::attach(LAMMPS_NS::LAMMPS* lmp, const std::string& mesh_id) {
  return add_own_fix<WallMotion>(lmp, {mesh_id + "_motion", "all", mesh_id});
}

WallMotion::WallMotion(LAMMPS_NS::LAMMPS* l, int narg, char** arg) : Fix(l, narg, arg) {
  const std::string mesh_id = arg[narg - 1];
  wall_ = dynamic_cast<FixMeshSurface*>(modify->find_fix_id(mesh_id.c_str()));
  if (wall_ == nullptr || std::strncmp(wall_->style, "mesh/surface/stress", 19) != 0) {
    throw std::runtime_error("the deck has no `fix " + mesh_id +
                             " all mesh/surface/stress ...` for the body '" + mesh_id + "'");
  }
  mesh_ = wall_->triMesh();
  // Before the first run every rank holds the whole mesh, in the body frame.
  for (int i = 0; i < mesh_->sizeLocal(); ++i) {
    const auto element = static_cast<std::size_t>(mesh_->id(i));
    if (element >= reference_.size()) reference_.resize(element + 1);
    auto& nodes = reference_[element];
    for (int j = 0; j < 3; ++j) mesh_->node(i, j, nodes[j].data());
  }
  mesh_->registerMove(false, true, true);
}

void WallMotion::place(const Pose& X_WB) {
  const Pose step = X_WB * inverse(X_WB_);
  turn(rotation_vector(step.R), Vector3d::Zero());
  mesh_->move(step.p.data());
  X_WB_ = X_WB;
}

void WallMotion::adopt(const Pose& X_WB, const setup::WallMemory& remembered) {
  const Pose X_BW = inverse(X_WB);
  for (auto& nodes : reference_) {
    for (auto& p : nodes) p = X_BW * p;
  }
  last_ = remembered.load;
  V_WB_W_ = remembered.V_WB_W;  // set-up computes forces, and damping needs the walls' velocity
  X_WB_ = X_WB;
}

void WallMotion::save(ByteWriter& out) const {
  out.put(reference_.size());
  for (const auto& nodes : reference_)
    for (const Vector3d& p : nodes)
      for (int k = 0; k < 3; ++k) out.put(p[k]);
  for (int k = 0; k < 3; ++k) out.put(X_WB_.p[k]);
  for (int k = 0; k < 4; ++k) out.put(X_WB_.R.coeffs()[k]);
}

void WallMotion::load(ByteReader& in) {
  reference_.resize(in.get<std::size_t>());
  for (auto& nodes : reference_)
    for (Vector3d& p : nodes)
      for (int k = 0; k < 3; ++k) p[k] = in.get<double>();
  for (int k = 0; k < 3; ++k) X_WB_.p[k] = in.get<double>();
  for (int k = 0; k < 4; ++k) X_WB_.R.coeffs()[k] = in.get<double>();
}

void WallMotion::begin_window(const Pose& X_WB_target, long n_steps) {
  // Starting from the pose read back removes the last window's rounding error.
  X_WB_ = pose_from_nodes();
  V_WB_W_ = twist_between(X_WB_, X_WB_target, static_cast<double>(n_steps) * update->dt);
  // Velocity Verlet gives the rock half of the first force and half of the last: the mean that
  // keeps the momentum balance is the trapezoidal one.
  sum_ = 0.5 * last_;
  steps_ = 0;
}

Box WallMotion::box() const {
  Box box;
  for (const auto& nodes : reference_)
    for (const auto& p : nodes) box.add(p);
  return box;
}

mesh::TriangleMesh WallMotion::in_world() const {
  mesh::TriangleMesh out;
  for (const auto& nodes : reference_)
    out.add_loose({X_WB_ * nodes[0], X_WB_ * nodes[1], X_WB_ * nodes[2]});
  return out;
}

core::BodyLoad WallMotion::end_window() {
  if (steps_ == 0) return {last_, last_, pose_from_nodes()};
  return {(1.0 / static_cast<double>(steps_)) * (sum_ + (-0.5) * last_), last_, pose_from_nodes()};
}

int WallMotion::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return INITIAL_INTEGRATE | PRE_FORCE | FINAL_INTEGRATE;
}

void WallMotion::setup_pre_force(int) {
  auto& prop = mesh_->prop();
  if (prop.getElementProperty<NodeVelocity>("v") == nullptr) {
    prop.addElementProperty<NodeVelocity>("v", "comm_exchange_borders", "frame_invariant",
                                          "restart_no");
  }
  impose_velocity();
}

void WallMotion::initial_integrate(int) {
  const double dt = update->dt;
  const Vector3d dp = V_WB_W_.v * dt;
  turn(V_WB_W_.w * dt, X_WB_.p);
  mesh_->move(dp.data());
  X_WB_ = {(from_rotation_vector(V_WB_W_.w * dt) * X_WB_.R).normalized(), X_WB_.p + dp};
  impose_velocity();
}

void WallMotion::final_integrate() {
  // compute_vector: 0..2 total force, 3..5 total torque about the reference point, summed over
  // ranks by the mesh's own final_integrate, which ran before.
  for (int k = 0; k < 3; ++k) {
    last_.force[k] = wall_->compute_vector(k);
    last_.torque[k] = wall_->compute_vector(3 + k);
  }
  sum_ = sum_ + last_;
  ++steps_;
}

void WallMotion::turn(const Vector3d& rotation, const Vector3d& p_WQ) {
  const double angle = rotation.norm();
  if (angle > 0) mesh_->rotate(angle, rotation.data(), p_WQ.data());
}

void WallMotion::impose_velocity() {
  double*** v = mesh_->prop().getElementProperty<NodeVelocity>("v")->begin();
  for (int i = 0; i < mesh_->size(); ++i) {
    for (int j = 0; j < 3; ++j) {
      Vector3d x;
      mesh_->node(i, j, x.data());
      const Vector3d v_W = V_WB_W_.v + V_WB_W_.w.cross(x - X_WB_.p);
      std::copy_n(v_W.data(), 3, v[i][j]);
    }
  }
}

Pose WallMotion::pose_from_nodes() const {
  // Rigid fit (Kabsch 1976): centroids, then the rotation from the SVD of the covariance. Offsets
  // are taken from the first estimate, X_WB_, so that sums do not cancel.
  double sums[16] = {};  // count, sum b, sum w, sum w b^T
  Eigen::Map<Vector3d> sum_b(sums + 1), sum_w(sums + 4);
  Eigen::Map<Eigen::Matrix3d> sum_wb(sums + 7);
  for (int i = 0; i < mesh_->sizeLocal(); ++i) {
    const auto& nodes = reference_[static_cast<std::size_t>(mesh_->id(i))];
    for (int j = 0; j < 3; ++j) {
      Vector3d p_W;
      mesh_->node(i, j, p_W.data());
      const Vector3d w = p_W - X_WB_.p;
      sums[0] += 1;
      sum_b += nodes[j];
      sum_w += w;
      sum_wb += w * nodes[j].transpose();
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 16, MPI_DOUBLE, MPI_SUM, world);
  const double n = sums[0];
  const Eigen::Matrix3d covariance = sum_wb - sum_w * sum_b.transpose() / n;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  if (R.determinant() < 0) {
    R = svd.matrixU() * Vector3d(1, 1, -1).asDiagonal() * svd.matrixV().transpose();
  }
  return {Quaterniond(R).normalized(), X_WB_.p + sum_w / n - R * sum_b / n};
}

}  // namespace dipper::dem
