#include "mbs/shovel_system.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "common/gravity.hpp"
#include "mbs/convert.hpp"

namespace dipper::mbs {
namespace {

using SimTK::MassProperties;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;

enum Work { kDriveWork, kInterfaceWork, kDissipated, kWorks };

/// Simbody's hinge turns about its frame's z: these turn that z to y and to -y, keeping x.
Rotation z_to_y() { return Rotation(-SimTK::Pi / 2, SimTK::XAxis); }
Rotation z_to_minus_y() { return Rotation(SimTK::Pi / 2, SimTK::XAxis); }

/// Mass properties about a body's origin from those about its mass centre.
MassProperties solid(double mass, const Vec3& center, const Vec3& central_inertia) {
  return {mass, center, SimTK::Inertia(central_inertia).shiftFromMassCenter(center, mass)};
}

/// Of two bodies that move as one, in the same axes about the same origin.
MassProperties together(const MassProperties& a, const MassProperties& b) {
  const double mass = a.getMass() + b.getMass();
  return {mass, (a.getMass() * a.getMassCenter() + b.getMass() * b.getMassCenter()) / mass,
          a.calcInertia() + b.calcInertia()};
}

}  // namespace

/// The drives' set points, where an integrator's stages ask for them.
class ShovelSystem::Target {
 public:
  explicit Target(SetPoint source) : source_(std::move(source)) {}

  const machine::DriveState& at(double t_s) {
    if (t_s != t_s_) {
      now_ = source_(t_s);
      t_s_ = t_s;
    }
    return now_;
  }
  /// Accelerations may jump at the end of a step; this is their value before it. A picosecond is
  /// far above a double's resolution there, and far below the motion's time scales.
  const machine::DriveState& before_jump(double t_s) {
    return t_s < end_s_ ? at(t_s) : at(end_s_ - 1e-12);
  }
  void set_end(double t_s) { end_s_ = t_s; }
  void forget() { t_s_ = std::numeric_limits<double>::quiet_NaN(); }

 private:
  SetPoint source_;
  double t_s_ = std::numeric_limits<double>::quiet_NaN();
  double end_s_ = std::numeric_limits<double>::infinity();
  machine::DriveState now_;
};

/// A prescribed drive.
struct ShovelSystem::DriveMotion : SimTK::Motion::Custom::Implementation {
  DriveMotion(Target& to, double machine::Drives::*which, double factor)
      : target(to), drive(which), scale(factor) {}
  Implementation* clone() const override { return new DriveMotion(*this); }
  SimTK::Motion::Level getLevel(const State&) const override { return SimTK::Motion::Position; }
  void calcPrescribedPosition(const State& s, int, double* q) const override {
    *q = scale * target.at(s.getTime()).position.*drive;
  }
  void calcPrescribedPositionDot(const State& s, int, double* q) const override {
    *q = scale * target.at(s.getTime()).rate.*drive;
  }
  void calcPrescribedPositionDotDot(const State& s, int, double* q) const override {
    *q = scale * target.before_jump(s.getTime()).acceleration.*drive;
  }
  Target& target;
  double machine::Drives::*drive;
  double scale;  ///< of the joint's coordinate against the drive's
};

/// Ropes, drives, friction and stops as a force of Simbody. Their energies, and the works, are its
/// auxiliary variables.
struct ShovelSystem::Forces : SimTK::Force::Custom::Implementation {
  explicit Forces(ShovelSystem& shovel) : s(shovel) {}

  void realizeTopology(State& state) const override {
    s.forces_.allocateZ(state, SimTK::Vector(kWorks + s.laws_.rope_numbers(), 0.0));
  }
  Eigen::VectorXd rope(const State& state) const {
    Eigen::VectorXd nodes(s.laws_.rope_numbers());
    const SimTK::Vector& z = state.getZ();
    for (int i = 0; i < nodes.size(); ++i) nodes[i] = z[kWorks + i];
    return nodes;
  }
  void calcForce(const State& state, SimTK::Vector_<SpatialVec>& on, SimTK::Vector_<Vec3>&,
                 SimTK::Vector& applied) const override {
    place = s.place(state);
    try {
      now = s.laws_.at(place, rope(state), s.target_->at(state.getTime()), s.held_);
    } catch (const std::exception& e) {
      fault = e.what();
      throw;
    }
    for (int j = 0; j < kJoints; ++j) applied[j] += now.applied[j];
    const Transform& X_WH = s.house_.getBodyTransform(state);
    const Vec3 pull_W = X_WH.R() * vec(now.pull);
    const Vec3 bail_W = X_WH.R() * vec(place.bail);  // from H's origin
    const Vec3 to_bail = X_WH.p() + bail_W - s.dipper_.getBodyTransform(state).p();
    on[s.dipper_.getMobilizedBodyIndex()] += SpatialVec(to_bail % pull_W, pull_W);
    // Its pull on the sheaves' axis and the drum has the same line of action.
    on[s.house_.getMobilizedBodyIndex()] -= SpatialVec(bail_W % pull_W, pull_W);
  }
  double calcPotentialEnergy(const State&) const override { return now.potential; }
  void realizeAcceleration(const State& state) const override {
    SimTK::Vector& rates = s.forces_.updZDot(state);
    const DriveReport d = s.laws_.report(now, place.q, place.u, s.reaction(state));
    rates[kDriveWork] = d.power();
    rates[kInterfaceWork] = s.rock_power(state);
    rates[kDissipated] = d.dissipated_power;
    for (int i = 0; i < now.rope_rates.size(); ++i) rates[kWorks + i] = now.rope_rates[i];
  }

  ShovelSystem& s;
  // As at the last realization to Dynamics, which precedes one to Acceleration.
  mutable ShovelPlace place;
  mutable ShovelLoads now;
  mutable std::string fault;  ///< Simbody's integrator does not pass on what a force throws
};

ShovelSystem::ShovelSystem(const machine::MachineData& m, machine::DriveMode mode, const Pose& X_W0,
                           double rake, double longest_step_s, SetPoint set_point)
    : laws_(m, mode),
      target_(std::make_unique<Target>(std::move(set_point))),
      bail_B_(m.dipper.bail.x(), 0, m.dipper.bail.z()),
      longest_step_s_(std::min(longest_step_s, laws_.longest_step())),
      matter_(system_),
      forces_(system_),
      gravity_(forces_, matter_, Vec3(0, 0, -kGravity_m_s2)),
      rock_forces_(forces_, matter_) {
  house_ = MobilizedBody::Pin(
      matter_.Ground(), transform(X_W0),
      SimTK::Body::Rigid(solid(m.house.mass, Vec3(0), Vec3(m.house.swing_inertia))), Transform());
  sheaves_ = MobilizedBody::Pin(
      house_, Transform(z_to_y(), vec(m.boom.point)),
      SimTK::Body::Rigid(
          solid(m.boom.sheave_mass, Vec3(0), Vec3(m.boom.sheave_inertia + laws_.drum_inertia()))),
      Transform(z_to_y()));
  saddle_ =
      MobilizedBody::Pin(house_, Transform(z_to_minus_y(), vec(m.saddle.position)),
                         SimTK::Body::Rigid(solid(m.saddle.mass, Vec3(0), Vec3(m.saddle.inertia))),
                         Transform(z_to_minus_y()));
  // The handle's dipper end, whose axes are the handle's, in B.
  const Transform X_BE(Rotation(rake, SimTK::YAxis), vec(m.dipper.handle_end));
  const MassProperties handle =
      solid(m.handle.mass, Vec3(m.handle.mass_center, 0, 0), vec(m.handle.inertia));
  const MassProperties dipper =
      solid(m.dipper.mass, vec(m.dipper.mass_center), vec(m.dipper.inertia));
  dipper_ = MobilizedBody::Slider(
      saddle_, Transform(Vec3(m.handle.reach_at_zero_crowd, 0, 0)),
      SimTK::Body::Rigid(together(handle.calcTransformedMassProps(~X_BE), dipper)), X_BE);
  door_ = MobilizedBody::Pin(
      dipper_, Transform(z_to_y(), vec(m.door.hinge)),
      SimTK::Body::Rigid(solid(m.door.mass, vec(m.door.mass_center), vec(m.door.inertia))),
      Transform(z_to_y()));
  prescribe(door_, &machine::Drives::door, 1);
  if (mode == machine::DriveMode::prescribed) {
    prescribe(house_, &machine::Drives::swing, 1);
    prescribe(sheaves_, &machine::Drives::hoist, 1 / m.boom.sheave_radius);
    prescribe(dipper_, &machine::Drives::crowd, 1);
  }
  loads_ = new Forces(*this);
  const SimTK::Force::Custom added(forces_, loads_);
  blank_ = system_.realizeTopology();
  system_.realizeModel(blank_);
  ahead_ = blank_;
}

ShovelSystem::~ShovelSystem() = default;

void ShovelSystem::prescribe(MobilizedBody& body, double machine::Drives::*drive, double scale) {
  const SimTK::Motion::Custom added(body, new DriveMotion(*target_, drive, scale));
}

ShovelPlace ShovelSystem::place(const State& state) const {
  ShovelPlace at;
  for (int j = 0; j < kJoints; ++j) {
    at.q[j] = state.getQ()[j];
    at.u[j] = state.getU()[j];
  }
  at.bail = vec(dipper_.findStationLocationInAnotherBody(state, vec(bail_B_), house_));
  at.bail_rate = vec(dipper_.findStationVelocityInAnotherBody(state, vec(bail_B_), house_));
  at.gravity = vec(~house_.getBodyRotation(state) * Vec3(0, 0, -kGravity_m_s2));
  return at;
}

Joints ShovelSystem::reaction(const State& state) const {
  matter_.findMotionForces(state, scratch_);  // in M u' + tau = f
  Joints tau;
  for (int j = 0; j < kJoints; ++j) tau[j] = -scratch_[j];
  return tau;
}

double ShovelSystem::rock_power(const State& state) const {
  double sum = 0;
  for (const auto& [body, F] : {std::pair(&dipper_, &rock_[0]), std::pair(&door_, &rock_[1])}) {
    const SpatialVec& V = body->getBodyVelocity(state);
    sum += SimTK::dot(V[0], vec(F->torque)) + SimTK::dot(V[1], vec(F->force));
  }
  return sum;
}

ShovelNumbers ShovelSystem::find_equilibrium(const machine::Drives& position, double saddle) {
  State s = blank_;
  ShovelNumbers at;
  at.q = laws_.joints(position);
  for (int j = 0; j < kJoints; ++j) s.updQ()[j] = at.q[j];
  held_ = true;
  for (MobilizedBody* b : {&house_, &sheaves_, &dipper_, &door_}) b->lock(s);
  const auto rises = [&](double angle) {
    at.q[kSaddle] = angle;
    s.updQ()[kSaddle] = angle;
    system_.realize(s, SimTK::Stage::Velocity);
    at.rope = laws_.settled_rope(place(s));
    for (int i = 0; i < at.rope.size(); ++i) s.updZ()[kWorks + i] = at.rope[i];
    system_.realize(s, SimTK::Stage::Acceleration);
    return s.getUDot()[kSaddle] > 0;
  };
  // With the rope just slack the dipper falls.
  double high = saddle, low = saddle - 1e-3;
  while (!rises(low)) {  // until the stretched rope pulls it up
    low -= 1e-3;
    if (high - low > 0.2)
      throw std::runtime_error("the hoist ropes do not hold the dipper at t = 0");
  }
  double middle = 0.5 * (low + high);
  while (middle > low && middle < high) {
    (rises(middle) ? low : high) = middle;
    middle = 0.5 * (low + high);
  }
  rises(middle);
  laws_.hold(reaction(s));
  held_ = false;
  return at;
}

void ShovelSystem::set(double t_s, const ShovelNumbers& n) {
  target_->set_end(std::numeric_limits<double>::infinity());
  target_->forget();
  State s = blank_;
  s.setTime(t_s);
  for (int j = 0; j < kJoints; ++j) {
    s.updQ()[j] = n.q[j];
    s.updU()[j] = n.u[j];
  }
  for (int i = 0; i < kWorks; ++i) s.updZ()[i] = n.works[i];
  for (int i = 0; i < n.rope.size(); ++i) s.updZ()[kWorks + i] = n.rope[i];
  integrator_ = std::make_unique<SimTK::RungeKutta3Integrator>(system_);
  integrator_->setFixedStepSize(longest_step_s_);
  integrator_->setProjectEveryStep(false);
  integrator_->initialize(s);
}

void ShovelSystem::hold(const Wrenches& rock) {
  rock_ = rock;
  const auto spatial = [](const Wrench& F) { return SpatialVec(vec(F.torque), vec(F.force)); };
  rock_forces_.setOneBodyForce(state(), dipper_, spatial(rock[0]));
  rock_forces_.setOneBodyForce(state(), door_, spatial(rock[1]));
}

void ShovelSystem::set_points_changed() { target_->forget(); }

void ShovelSystem::step_to(double t_s) {
  target_->set_end(t_s);
  loads_->fault.clear();
  const double t0 = state().getTime();
  const double n = std::max(1.0, std::ceil((t_s - t0) / longest_step_s_ - 1e-9));
  for (double k = 1; k <= n; ++k) {
    const double next = k == n ? t_s : t0 + k * (t_s - t0) / n;
    if (k == 1) {
      state().invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
      integrator_->reinitialize(SimTK::Stage::Dynamics, false);
    }
    try {
      while (integrator_->getTime() < next) integrator_->stepTo(next, next);
    } catch (const std::exception& e) {
      throw std::runtime_error(loads_->fault.empty() ? e.what() : loads_->fault);
    }
  }
  target_->set_end(std::numeric_limits<double>::infinity());
  state().invalidateAllCacheAtOrAbove(SimTK::Stage::Dynamics);
}

ShovelNumbers ShovelSystem::numbers() const {
  const State& s = integrator_->getAdvancedState();
  ShovelNumbers n;
  for (int j = 0; j < kJoints; ++j) {
    n.q[j] = s.getQ()[j];
    n.u[j] = s.getU()[j];
  }
  for (int i = 0; i < kWorks; ++i) n.works[i] = s.getZ()[i];
  n.rope = loads_->rope(s);
  return n;
}

ShovelInstant ShovelSystem::instant() {
  State& s = state();
  system_.realize(s, SimTK::Stage::Acceleration);
  ShovelInstant i{Joints::Zero(), reaction(s), loads_->now, {}, rock_power(s), 0, 0};
  for (int j = 0; j < kJoints; ++j) i.acceleration[j] = s.getUDot()[j];
  i.drives = laws_.report(i.loads, loads_->place.q, loads_->place.u, i.reaction);
  i.kinetic = matter_.calcKineticEnergy(s) + i.loads.kinetic;
  i.potential = gravity_.calcPotentialEnergyContribution(s) + i.loads.potential;
  return i;
}

const ShovelLoads& ShovelSystem::loads() {
  system_.realize(state(), SimTK::Stage::Dynamics);
  return loads_->now;
}

std::array<BodyState, kBodies> ShovelSystem::bodies() {
  State& s = state();
  system_.realize(s, SimTK::Stage::Velocity);
  const auto of = [&](const MobilizedBody& body) {
    const SpatialVec& V = body.getBodyVelocity(s);
    return BodyState{pose(body.getBodyTransform(s)), {vec(V[0]), vec(V[1])}};
  };
  return {of(dipper_), of(door_)};
}

std::array<Pose, kBodies> ShovelSystem::poses_in(double h) {
  const State& s = state();
  ahead_.setTime(s.getTime() + h);
  for (int j = 0; j < kJoints; ++j) {
    ahead_.updQ()[j] = s.getQ()[j] + h * (s.getU()[j] + 0.5 * h * s.getUDot()[j]);
  }
  system_.realize(ahead_, SimTK::Stage::Time);
  system_.prescribeQ(ahead_);
  system_.realize(ahead_, SimTK::Stage::Position);
  return {pose(dipper_.getBodyTransform(ahead_)), pose(door_.getBodyTransform(ahead_))};
}

}  // namespace dipper::mbs
