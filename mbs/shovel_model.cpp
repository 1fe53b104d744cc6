#include "mbs/shovel_model.hpp"

#include "common/gravity.hpp"
#include "mbs/convert.hpp"

namespace dipper::mbs {
namespace {

using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::Transform;
using SimTK::Vec3;

/// Simbody's hinge turns about its frame's z: these turn that z to y and to -y, keeping x.
Rotation z_to_y() { return Rotation(-SimTK::Pi / 2, SimTK::XAxis); }
Rotation z_to_minus_y() { return Rotation(SimTK::Pi / 2, SimTK::XAxis); }

/// Mass properties about a body's origin from those about its mass centre.
SimTK::MassProperties solid(double mass, const Vec3& center, const Vec3& central_inertia) {
  return {mass, center, SimTK::Inertia(central_inertia).shiftFromMassCenter(center, mass)};
}

}  // namespace

ShovelModel::ShovelModel(const machine::MachineData& m, const Pose& X_W0, double rake,
                         double drum_inertia)
    : matter_(system_), bail_(m.dipper.bail.x(), 0, m.dipper.bail.z()) {
  house_ = SimTK::MobilizedBody::Pin(
      matter_.Ground(), transform(X_W0),
      SimTK::Body::Rigid(solid(m.house.mass, Vec3(0), Vec3(m.house.swing_inertia))), Transform());
  sheaves_ = SimTK::MobilizedBody::Pin(
      house_, Transform(z_to_y(), vec(m.boom.point)),
      SimTK::Body::Rigid(
          solid(m.boom.sheave_mass, Vec3(0), Vec3(m.boom.sheave_inertia + drum_inertia))),
      Transform(z_to_y()));
  saddle_ = SimTK::MobilizedBody::Pin(
      house_, Transform(z_to_minus_y(), vec(m.saddle.position)),
      SimTK::Body::Rigid(solid(m.saddle.mass, Vec3(0), Vec3(m.saddle.inertia))),
      Transform(z_to_minus_y()));
  handle_ = SimTK::MobilizedBody::Slider(
      saddle_, Transform(Vec3(m.handle.reach_at_zero_crowd, 0, 0)),
      SimTK::Body::Rigid(
          solid(m.handle.mass, Vec3(m.handle.mass_center, 0, 0), vec(m.handle.inertia))),
      Transform());
  const Rotation R_EB(-rake, SimTK::YAxis);
  dipper_ = SimTK::MobilizedBody::Weld(
      handle_, Transform(R_EB, -(R_EB * vec(m.dipper.handle_end))),
      SimTK::Body::Rigid(solid(m.dipper.mass, vec(m.dipper.mass_center), vec(m.dipper.inertia))),
      Transform());
  door_ = SimTK::MobilizedBody::Pin(
      dipper_, Transform(z_to_y(), vec(m.door.hinge)),
      SimTK::Body::Rigid(solid(m.door.mass, vec(m.door.mass_center), vec(m.door.inertia))),
      Transform(z_to_y()));
  weights_ = {{house_, m.house.mass, Vec3(0)},
              {sheaves_, m.boom.sheave_mass, Vec3(0)},
              {saddle_, m.saddle.mass, Vec3(0)},
              {handle_, m.handle.mass, Vec3(m.handle.mass_center, 0, 0)},
              {dipper_, m.dipper.mass, vec(m.dipper.mass_center)},
              {door_, m.door.mass, vec(m.door.mass_center)}};
  state_ = system_.realizeTopology();
  system_.realizeModel(state_);
  accelerations_.resize(kJoints);
  applied_.resize(kJoints);
  forces_.resize(matter_.getNumBodies());
}

Joints ShovelModel::reactions(const Joints& q, const Joints& u, const Joints& acceleration,
                              const Joints& applied, const Wrenches& rock, const Vector3d& pull) {
  SimTK::Vector& q_s = state_.updQ();
  SimTK::Vector& u_s = state_.updU();
  for (int j = 0; j < kJoints; ++j) {
    q_s[j] = q[j];
    u_s[j] = u[j];
    accelerations_[j] = acceleration[j];
    applied_[j] = applied[j];
  }
  system_.realize(state_, SimTK::Stage::Velocity);
  const auto on = [&](const SimTK::MobilizedBody& body) -> SpatialVec& {
    return forces_[body.getMobilizedBodyIndex()];
  };
  forces_ = SpatialVec(Vec3(0), Vec3(0));
  for (const Weight& w : weights_) {
    const Vec3 force(0, 0, -w.mass * kGravity_m_s2);
    on(w.body) += SpatialVec((w.body.getBodyRotation(state_) * w.center) % force, force);
  }
  on(dipper_) += SpatialVec(vec(rock[0].torque), vec(rock[0].force));
  on(door_) += SpatialVec(vec(rock[1].torque), vec(rock[1].force));
  const Transform& X_WH = house_.getBodyTransform(state_);
  const Transform& X_WB = dipper_.getBodyTransform(state_);
  const Vec3 pull_W = X_WH.R() * vec(pull), to_bail = X_WB.R() * bail_;
  on(dipper_) += SpatialVec(to_bail % pull_W, pull_W);
  // What it pulls with on the sheaves' axis and the drum has the same line of action.
  on(house_) -= SpatialVec((X_WB.p() + to_bail - X_WH.p()) % pull_W, pull_W);
  matter_.calcResidualForceIgnoringConstraints(state_, applied_, forces_, accelerations_,
                                               residual_);
  Joints tau;
  for (int j = 0; j < kJoints; ++j) tau[j] = residual_[j];
  return tau;
}

}  // namespace dipper::mbs
