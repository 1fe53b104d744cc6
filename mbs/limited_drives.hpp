// Hoist, crowd and swing as motors that follow their set points as far as their limits allow.
#pragma once

#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/drive_limit.hpp"

namespace dipper::mbs {

/// One drive's force: along its coordinate, N, swing N m.
struct DriveEffort {
  double wanted;
  double most;
  double force;
  double speed;
  double sent_speed;
  bool saturated() const { return wanted > most || wanted < -most; }

  /// The force it wants over the most it can give. Zero for a drive that a slower set point would
  /// not help: one that brakes, since it is ahead of its set point, and one that is to stand, as
  /// the swing while the dipper digs.
  double overload() const;
};

/// What a drive wants over what it can do, of those that push the way they are sent.
struct Overload {
  double crowd = 0;
  double others = 0;  ///< the larger of hoist's and swing's
};

struct DriveEfforts {
  DriveEffort hoist, crowd, swing;

  Overload overload() const;
};

/// The motors of the drum, of the handle's slide and of the house.
class LimitedDrives {
 public:
  explicit LimitedDrives(const machine::MachineData& machine);

  /// Forces that hold the machine at its initial position, along hoist, crowd and swing.
  void set_trims(const machine::Drives& force);

  /// The state of the drives for set points and positions.
  DriveEfforts efforts(const machine::DriveState& sent, const machine::DriveState& are) const;

 private:
  LimitedDrive hoist_, crowd_, swing_;
};

}  // namespace dipper::mbs
