#include "mbs/shovel_model.hpp"

#include "common/gravity.hpp"
#include "mbs/convert.hpp"
#include "mbs/prescribed.hpp"

namespace dipper::mbs {
namespace {

using SimTK::Rotation;
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

ShovelModel::ShovelModel(const machine::MachineData& m, const Sent& sent, machine::DriveMode mode,
                         const Pose& X_W0, double rake)
    : matter(system), forces(system) {
  forces.setNumberOfThreads(1);  // one order of summation, and nothing here is worth a thread
  const SimTK::Force::UniformGravity gravity(forces, matter, Vec3(0, 0, -kGravity_m_s2));

  house = SimTK::MobilizedBody::Pin(
      matter.Ground(), transform(X_W0),
      SimTK::Body::Rigid(solid(m.house.mass, Vec3(0), Vec3(m.house.swing_inertia))), Transform());

  const bool prescribed = mode == machine::DriveMode::prescribed;
  const double R = m.boom.sheave_radius;
  const auto drive = [&](SimTK::MobilizedBody& joint, double machine::Drives::*which,
                         double scale = 1) {
    if (prescribed) prescribe(joint, sent, which, scale);
  };
  drive(house, &machine::Drives::swing);

  // The upper rope is rigid, so the sheaves turn with the rope paid out, and drum and motors, which
  // a prescribed hoist does not feel, with them.
  const double drum = prescribed ? 0 : m.drives.hoist_inertia * R * R;
  sheaves = SimTK::MobilizedBody::Pin(
      house, Transform(z_to_y(), vec(m.boom.point)),
      SimTK::Body::Rigid(solid(m.boom.sheave_mass, Vec3(0), Vec3(m.boom.sheave_inertia + drum))),
      Transform(z_to_y()));
  drive(sheaves, &machine::Drives::hoist, 1 / R);

  saddle = SimTK::MobilizedBody::Pin(
      house, Transform(z_to_minus_y(), vec(m.saddle.position)),
      SimTK::Body::Rigid(solid(m.saddle.mass, Vec3(0), Vec3(m.saddle.inertia))),
      Transform(z_to_minus_y()));
  const SimTK::Force::MobilityLinearDamper bearing(forces, saddle, SimTK::MobilizerUIndex(0),
                                                   m.saddle.damping);

  handle = SimTK::MobilizedBody::Slider(
      saddle, Transform(Vec3(m.handle.reach_at_zero_crowd, 0, 0)),
      SimTK::Body::Rigid(
          solid(m.handle.mass, Vec3(m.handle.mass_center, 0, 0), vec(m.handle.inertia))),
      Transform());
  drive(handle, &machine::Drives::crowd);

  const Rotation R_EB(-rake, SimTK::YAxis);
  dipper = SimTK::MobilizedBody::Weld(
      handle, Transform(R_EB, -(R_EB * vec(m.dipper.handle_end))),
      SimTK::Body::Rigid(solid(m.dipper.mass, vec(m.dipper.mass_center), vec(m.dipper.inertia))),
      Transform());

  door = SimTK::MobilizedBody::Pin(
      dipper, Transform(z_to_y(), vec(m.door.hinge)),
      SimTK::Body::Rigid(solid(m.door.mass, vec(m.door.mass_center), vec(m.door.inertia))),
      Transform(z_to_y()));
  prescribe(door, sent, &machine::Drives::door);

  if (!prescribed) {
    limited = new LimitedDrives(m, sent, sheaves, handle, house);
    const SimTK::Force::Custom motors(forces, limited);  // takes ownership
  }

  const auto hang = [&](double side) {
    const Vec3 mirror(1, side, 1);
    RopeSpec spec;
    spec.sheave_body = house;
    spec.sheave_center = vec(m.boom.point);
    spec.sheave_radius = m.boom.sheave_radius;
    spec.body_a = house;
    spec.station_a = vec(m.rope.drum).elementwiseMultiply(mirror);
    spec.body_b = dipper;
    spec.station_b = vec(m.dipper.bail).elementwiseMultiply(mirror);
    spec.axial_stiffness = m.rope.axial_stiffness;
    spec.elastic_fraction = m.rope.elastic_fraction;
    spec.damping = m.rope.damping;
    if (!prescribed) {
      spec.drum = sheaves;
      spec.drum_radius = R;
    }
    const double at_zero = m.rope.length_at_zero_hoist;
    auto* rope = new Rope(spec, [sent, at_zero, drives = limited](const SimTK::State& state) {
      const machine::DriveState s =
          drives != nullptr ? drives->where(state) : sent(state.getTime());
      return FreeLength{at_zero + s.position.hoist, s.rate.hoist};
    });
    const SimTK::Force::Custom force(forces, rope);  // takes ownership
    return rope;
  };
  rope_left = hang(+1);
  rope_right = hang(-1);

  auto* losses =
      new DriveFriction(m.losses, m.boom.sheave_radius, handle, sheaves, rope_left, rope_right);
  const SimTK::Force::Custom drive_losses(forces, losses);  // takes ownership
  friction = losses;

  rock = SimTK::Force::DiscreteForces(forces, matter);
  initial = system.realizeTopology();
  system.realizeModel(initial);
}

}  // namespace dipper::mbs
