#include "tests/mbs/shovel_tree.hpp"

#include <cmath>

#include "common/gravity.hpp"

namespace dipper::mbs {
namespace {

using Eigen::Matrix3d;

const Vector3d kGravity_W(0, 0, -kGravity_m_s2);

Matrix3d matrix(const Elevation& e) {
  Matrix3d m;
  m << e.c, 0, -e.s, 0, 1, 0, e.s, 0, e.c;
  return m;
}

/// -y x v: the velocity of what turns up at 1 rad/s.
Vector3d up(const Vector3d& v) { return {-v.z(), 0, v.x()}; }

/// z x v: the velocity of what swings at 1 rad/s.
Vector3d swung(const Vector3d& v) { return {-v.y(), v.x(), 0}; }

/// Of a point mass at d.
Matrix3d point_inertia(double mass, const Vector3d& d) {
  return mass * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
}

}  // namespace

Elevation::Elevation(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}

/// What a unit of a joint's rate moves: a point by v, and the body up (1), down (-1) or not.
struct ShovelTree::Column {
  Joint joint;
  Vector3d v;
  double pitch;
};

/// A body's mass centre, and what is left of its acceleration against H when no joint accelerates.
struct ShovelTree::Moving {
  Elevation turn;
  double pitch_rate;
  Vector3d r, rate, bias;
};

ShovelTree::ShovelTree(const machine::MachineData& m, const Pose& X_W0, double rake,
                       double drum_inertia)
    : X_W0_(X_W0),
      rake_(rake),
      reach_(m.handle.reach_at_zero_crowd),
      saddle_(m.saddle.position),
      door_{m.door.mass, m.door.mass_center, m.door.inertia.asDiagonal()},
      house_{m.house.mass, m.house.swing_inertia, Vector3d::Zero()},
      sheaves_{m.boom.sheave_mass, m.boom.sheave_inertia + drum_inertia, m.boom.point},
      block_{m.saddle.mass, m.saddle.inertia, m.saddle.position},
      total_mass_(m.house.mass + m.boom.sheave_mass + m.saddle.mass + m.handle.mass +
                  m.dipper.mass + m.door.mass) {
  const Elevation R_AB(rake);
  const auto from_end = [&](const Vector3d& p_B) -> Vector3d {
    return R_AB * (p_B - m.dipper.handle_end);
  };
  end_to_dipper_ = from_end(Vector3d::Zero());
  end_to_hinge_ = from_end(m.door.hinge);
  end_to_bail_ = from_end(m.dipper.bail);
  end_to_bail_.y() = 0;
  const Vector3d handle(m.handle.mass_center, 0, 0), dipper = from_end(m.dipper.mass_center);
  tool_.mass = m.handle.mass + m.dipper.mass;
  tool_.center = (m.handle.mass * handle + m.dipper.mass * dipper) / tool_.mass;
  const Matrix3d inertia_B = m.dipper.inertia.asDiagonal();
  tool_.inertia = matrix(R_AB) * inertia_B * matrix(R_AB).transpose() +
                  point_inertia(m.handle.mass, handle - tool_.center) +
                  point_inertia(m.dipper.mass, dipper - tool_.center);
  tool_.inertia.diagonal() += m.handle.inertia;
}

ShovelTree::Placement ShovelTree::place(const Joints& q, const Joints& u) const {
  const Elevation swing(q[kSwing]), handle(q[kSaddle]);
  const auto put = [&](const Vector3d& from_end) {
    const Vector3d p_A = from_end + Vector3d(reach_ + q[kCrowd], 0, 0);
    return Placement::Point{saddle_ + handle * p_A,
                            handle * (Vector3d(u[kCrowd], 0, 0) + u[kSaddle] * up(p_A))};
  };
  return {q,
          u,
          swing,
          handle,
          Elevation(q[kSaddle] + rake_),
          Elevation(q[kSaddle] + rake_ - q[kDoor]),
          put(end_to_dipper_),
          put(end_to_hinge_),
          put(end_to_bail_),
          to_house(kGravity_W, swing)};
}

Vector3d ShovelTree::to_house(const Vector3d& v_W, const Elevation& swing) const {
  const Vector3d v = X_W0_.R.conjugate() * v_W;
  return {swing.c * v.x() + swing.s * v.y(), swing.c * v.y() - swing.s * v.x(), v.z()};
}

void ShovelTree::add(const RoundPart& part, const Placement& at, Equations& e) {
  const Vector3d v_swing = swung(part.center);
  e.mass(kSwing, kSwing) += part.inertia + part.mass * v_swing.squaredNorm();
  e.force[kSwing] += part.mass * at.gravity.dot(v_swing);
  e.potential -= part.mass * at.gravity.dot(part.center);
}

template <std::size_t N>
void ShovelTree::add(const Part& part, const Moving& b, const std::array<Column, N>& columns,
                     const Placement& at, Equations& e) {
  const double psi = at.u[kSwing];
  // In the body's own axes: those of H, its angular velocity, and the couple that turns it as it
  // does when no joint accelerates.
  const Vector3d x = b.turn.undo(Vector3d::UnitX()), z = b.turn.undo(Vector3d::UnitZ());
  const Vector3d Iz = part.inertia * z;
  const Vector3d w = psi * z - b.pitch_rate * Vector3d::UnitY();
  const Vector3d couple = part.inertia * (psi * b.pitch_rate * x) +
                          w.cross(psi * Iz - b.pitch_rate * part.inertia.col(1));
  const Vector3d acceleration =
      b.bias + 2 * psi * swung(b.rate) - psi * psi * Vector3d(b.r.x(), b.r.y(), 0);
  const Vector3d force = part.mass * (at.gravity - acceleration), v_swing = swung(b.r);
  e.potential -= part.mass * at.gravity.dot(b.r);
  e.force[kSwing] += force.dot(v_swing) - couple.dot(z);
  e.mass(kSwing, kSwing) += part.mass * v_swing.squaredNorm() + z.dot(Iz);
  for (std::size_t j = 0; j < N; ++j) {
    const Column& c = columns[j];
    e.force[c.joint] += force.dot(c.v) + c.pitch * couple.y();
    e.mass(kSwing, c.joint) += part.mass * v_swing.dot(c.v) - c.pitch * Iz.y();
    for (std::size_t k = j; k < N; ++k) {
      e.mass(c.joint, columns[k].joint) +=
          part.mass * c.v.dot(columns[k].v) + c.pitch * columns[k].pitch * part.inertia(1, 1);
    }
  }
}

template <std::size_t N>
void ShovelTree::load(const Wrench& F_W, const Placement::Point& point, double pitch_rate,
                      const std::array<Column, N>& columns, const Placement& at,
                      Equations& e) const {
  const Vector3d force = to_house(F_W.force, at.swing), torque = to_house(F_W.torque, at.swing);
  const double about_z = force.dot(swung(point.r)) + torque.z();
  e.force[kSwing] += about_z;
  for (const Column& c : columns) e.force[c.joint] += force.dot(c.v) - c.pitch * torque.y();
  e.rock_power += force.dot(point.rate) + at.u[kSwing] * about_z - pitch_rate * torque.y();
}

ShovelTree::Equations ShovelTree::equations(const Placement& at, const Wrenches& rock,
                                            const Vector3d& pull) const {
  const Joints& u = at.u;
  const double pitch = u[kSaddle], door_pitch = u[kSaddle] - u[kDoor];
  const Vector3d end(reach_ + at.q[kCrowd], 0, 0), along = at.handle * Vector3d::UnitX();
  // Of points fixed to the handle, p_A from the saddle.
  const auto columns = [&](const Vector3d& p_A) {
    return std::array<Column, 2>{{{kSaddle, at.handle * up(p_A), 1}, {kCrowd, along, 0}}};
  };
  const auto bias = [&](const Vector3d& p_A) -> Vector3d {
    return at.handle *
           Vector3d(-pitch * pitch * p_A.x(), 0, 2 * pitch * u[kCrowd] - pitch * pitch * p_A.z());
  };

  Equations e;
  e.mass.setZero();
  e.force.setZero();
  e.potential = -total_mass_ * kGravity_W.dot(X_W0_.p);
  for (const RoundPart* part : {&house_, &sheaves_, &block_}) add(*part, at, e);
  e.mass(kSheaves, kSheaves) = sheaves_.inertia;
  e.mass(kSaddle, kSaddle) = block_.inertia;

  const Vector3d tool = end + tool_.center;
  add(tool_,
      {at.handle, pitch, saddle_ + at.handle * tool,
       at.handle * (Vector3d(u[kCrowd], 0, 0) + pitch * up(tool)), bias(tool)},
      columns(tool), at, e);

  const Vector3d hinge = end + end_to_hinge_, turned = at.door * up(door_.center);
  const std::array<Column, 2> of_hinge = columns(hinge);
  add(door_,
      {at.door, door_pitch, at.hinge.r + at.door * door_.center,
       at.hinge.rate + door_pitch * turned,
       bias(hinge) -
           door_pitch * door_pitch * (at.door * Vector3d(door_.center.x(), 0, door_.center.z()))},
      std::array<Column, 3>{
          {{kSaddle, of_hinge[0].v + turned, 1}, {kCrowd, along, 0}, {kDoor, -turned, -1}}},
      at, e);

  load(rock[0], at.dipper_origin, pitch, columns(end + end_to_dipper_), at, e);
  load(rock[1], at.hinge, door_pitch,
       std::array<Column, 3>{{of_hinge[0], of_hinge[1], {kDoor, Vector3d::Zero(), -1}}}, at, e);
  for (const Column& c : columns(end + end_to_bail_)) e.force[c.joint] += pull.dot(c.v);
  e.mass.triangularView<Eigen::StrictlyLower>() = e.mass.transpose();
  return e;
}

std::array<BodyState, kBodies> ShovelTree::bodies(const Placement& at) const {
  const Quaterniond R_WH =
      X_W0_.R * Quaterniond(Eigen::AngleAxisd(at.q[kSwing], Vector3d::UnitZ()));
  const auto body = [&](const Placement::Point& origin, double pitch, double pitch_rate) {
    const Quaterniond R_HB(Eigen::AngleAxisd(-pitch, Vector3d::UnitY()));
    const double psi = at.u[kSwing];
    return BodyState{
        {R_WH * R_HB, X_W0_.p + R_WH * origin.r},
        {R_WH * Vector3d(0, -pitch_rate, psi), R_WH * (origin.rate + psi * swung(origin.r))}};
  };
  const double pitch = at.q[kSaddle] + rake_;
  return {body(at.dipper_origin, pitch, at.u[kSaddle]),
          body(at.hinge, pitch - at.q[kDoor], at.u[kSaddle] - at.u[kDoor])};
}

}  // namespace dipper::mbs
