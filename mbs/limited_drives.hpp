// Hoist, crowd and swing as motors that follow where they are sent as far as they can.
#pragma once

#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/drive_limit.hpp"

namespace dipper::mbs {

/// What one drive does: along its coordinate, N, swing N m.
struct DriveEffort {
  double wanted;
  double most;
  double force;
  double speed;
  double sent_speed;
  bool saturated() const { return wanted > most || wanted < -most; }

  /// What it wants over what it can do. One that brakes is ahead of where it is sent, and sending
  /// it slower would be no help: it has none.
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

  /// Forces that hold the machine where it stands at the start, along hoist, crowd and swing.
  void set_trims(const machine::Drives& force);

  /// Of drives that are sent somewhere and are somewhere.
  DriveEfforts efforts(const machine::DriveState& sent, const machine::DriveState& are) const;

 private:
  LimitedDrive hoist_, crowd_, swing_;
};

}  // namespace dipper::mbs
