#include "mbs/drive_friction.hpp"

#include <cmath>

namespace dipper::mbs {

DriveFriction::DriveFriction(const machine::MachineData::Losses& losses, double sheave_radius,
                             SimTK::MobilizedBody handle, SimTK::MobilizedBody sheaves,
                             const Rope* left, const Rope* right)
    : losses_(losses),
      radius_(sheave_radius),
      handle_(std::move(handle)),
      sheaves_(std::move(sheaves)),
      left_(left),
      right_(right) {}

double DriveFriction::crowd_force(const SimTK::State& state) const {
  return -losses_.crowd_friction * std::tanh(handle_.getOneU(state, 0) / kStandstill);
}

double DriveFriction::sheave_torque(const SimTK::State& state) const {
  if (losses_.hoist_loss == 0) return 0;
  const double tension = left_->evaluate(state).tension + right_->evaluate(state).tension;
  const double speed = radius_ * sheaves_.getOneU(state, 0);
  return -losses_.hoist_loss * radius_ * tension * std::tanh(speed / kStandstill);
}

void DriveFriction::calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>&,
                              SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector& mobility_forces) const {
  handle_.applyOneMobilityForce(state, 0, crowd_force(state), mobility_forces);
  sheaves_.applyOneMobilityForce(state, 0, sheave_torque(state), mobility_forces);
}

double DriveFriction::dissipation(const SimTK::State& state) const {
  return -crowd_force(state) * handle_.getOneU(state, 0) -
         sheave_torque(state) * sheaves_.getOneU(state, 0);
}

}  // namespace dipper::mbs
