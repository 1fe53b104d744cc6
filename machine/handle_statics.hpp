// What holds the dipper: the balance of handle, dipper, door and load about the saddle.
#pragma once

#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::machine {

/// What forces do to the handle in the plane of the boom. Burdens add up.
struct Burden {
  double moment = 0;  ///< N m about the saddle's pivot; positive lifts
  double along = 0;   ///< N along the handle, outward

  Burden operator+(const Burden& b) const { return {moment + b.moment, along + b.along}; }
  Burden operator-(const Burden& b) const { return {moment - b.moment, along - b.along}; }
};
inline Burden operator*(double factor, const Burden& b) {
  return {factor * b.moment, factor * b.along};
}

/// Of hoist (both ropes together) and crowd, N.
struct Holding {
  double hoist = 0, crowd = 0;
};

/// What is in the dipper, and what it meets.
struct DigLoad {
  double load_kg = 0;
  double resistance_N = 0;  ///< on the teeth, along the dipper's floor toward the heel
};

/// The machine in one place, at rest, with taut ropes.
class HandlePlace {
 public:
  /// Of a force at a point, both in the plane of the boom (x out from the swing axis, z up).
  Burden of(const Vector2d& p, const Vector2d& force) const;
  /// Of a mass at a point. \param swing_rad_s  of the house, whose turning pulls it outward
  Burden of_mass(double kg, const Vector2d& p, double swing_rad_s = 0) const;
  /// Of handle, dipper and door.
  Burden empty(double swing_rad_s = 0) const;
  /// Of a kilogram of load, and of a newton of resistance on the teeth.
  Burden of_a_kg(double swing_rad_s = 0) const { return of_mass(1, load_, swing_rad_s); }
  Burden of_a_newton() const { return of(teeth_, -floor_); }

  double arm() const { return arm_; }  ///< of the ropes about the saddle, m

  /// What holds a burden: the ropes its moment, and the crowd what they leave along the handle.
  /// Ropes that would have to push carry nothing; the moment is then the ground's.
  Holding holding(const Burden& burden) const;
  /// The burden that these hold.
  Burden held(const Holding& by) const;
  /// Load and resistance by hoist and crowd together, below 0 too: two balances, two unknowns.
  DigLoad dig_load(const Holding& by) const;
  double handle_rise() const { return out_.y(); }  ///< sine of its angle over the horizontal

 private:
  friend class HandleStatics;
  double mass_of_handle_ = 0, mass_of_dipper_ = 0, mass_of_door_ = 0;
  Vector2d saddle_, out_, rope_;  ///< the handle's and the rope's directions, from bail to sheave
  double arm_ = 0;
  Vector2d handle_, dipper_, door_, load_, teeth_, floor_;
};

/// Moments about the saddle and forces along the handle, in balance while the dipper stands still.
/// The masses are those of the machine's file: what rides on the dipper (liners, rock that sticks)
/// is weighed as load, and so are forces of the face and of acceleration.
class HandleStatics {
 public:
  /// \param rake  handle centre line to dipper floor, rad
  /// \param load_B  where the load's weight acts, m
  HandleStatics(const MachineData& machine, double rake, const Vector3d& load_B);
  /// With the load in the middle of the dipper's inside.
  HandleStatics(const MachineData& machine, double rake);

  /// Swing and door have no effect: the house looks ahead, and the door is shut. Throws
  /// std::domain_error where the ropes have no path (ShovelKinematics::saddle_angle).
  HandlePlace at(const Drives& drives) const;

  /// The load by the hoist's pull alone, kg, below 0 too: all that pulls down is weighed. Throws as
  /// `at`.
  double load_kg(const Drives& drives, double hoist_N) const;

 private:
  MachineData machine_;
  ShovelKinematics shovel_;
  Vector3d load_B_;
};

}  // namespace dipper::machine
