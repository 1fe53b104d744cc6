// Demands on the machine in a part of a run: deviation of the teeth, forces beyond the drives'
// limits.
#pragma once

#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "machine/kinematics.hpp"

namespace dipper::analysis::signals {

/// In a part of a run. Fractions are of its time, 0 ... 1.
struct Demand {
  /// Largest distance [m] of the tooth tips from where taut, rigid ropes of the same length would
  /// have them: some centimetres under load, more where the dipper rides on rock.
  double teeth_deviation_m = 0;
  double hoist_beyond_fraction = 0;  ///< the ropes pull with more than the machine's hoist_stall
  /// The crowd's motor holds the handle with more than the machine's crowd_stall: never where the
  /// drive is limited.
  double crowd_beyond_fraction = 0;
};

class MachineDemand {
 public:
  /// \param rake handle's centre line to dipper's floor, rad
  /// \param saddle_rad the handle above the horizontal, one entry for each sync step
  MachineDemand(const machine::MachineData& machine, double rake, std::vector<double> saddle_rad);

  /// \param s with forces, of the same sync steps
  /// \param rope_tension_N  of both hoist ropes together, an entry for each
  Demand over(const DriveSignals& s, const std::vector<double>& rope_tension_N, double t_start_s,
              double t_end_s) const;

 private:
  double teeth_off_m(const DriveSignals& s, std::size_t i) const;

  machine::MachineData::DriveLimits drives_;
  machine::ShovelKinematics taut_;
  std::vector<double> saddle_rad_;
};

}  // namespace dipper::analysis::signals
