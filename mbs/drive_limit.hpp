// A motor with limits, and its controller.
#pragma once

#include "machine/machine_data.hpp"

namespace dipper::mbs {

/// A drive of one joint. What its controller asks for,
///   F = trim + K (x_sent - x) + C (v_sent - v),   K = stall / lag,  C = 2 sqrt(K m),
/// is damped critically for a moved mass m; the motor gives it within
///   |F| <= min(stall, power / |v|).
/// So a drive at its limit is about `lag` behind its set point.
class LimitedDrive {
 public:
  /// \param lag  m, swing rad
  /// \param moved_mass  kg, swing kg m^2
  LimitedDrive(const machine::MachineData::DriveLimit& limit, double lag, double moved_mass);

  /// The force that holds it at the start; N, N m.
  void set_trim(double force) { trim_ = force; }

  /// \param behind  x_sent - x
  /// \param slower  v_sent - v
  double wanted(double behind, double slower) const;

  /// Its largest force at a speed, N, N m.
  double most(double speed) const;

  /// The force it gives.
  double force(double wanted, double speed) const;

 private:
  machine::MachineData::DriveLimit limit_;
  double stiffness_, damping_;
  double trim_ = 0;
};

}  // namespace dipper::mbs
