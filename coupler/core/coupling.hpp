// The co-simulation step: who moves first, what is held, and what it costs in energy.
#pragma once

#include <cstdint>
#include <vector>

#include "coupler/core/server.hpp"

namespace dipper::core {

enum class Scheme {
  serial,    ///< the machine takes the window with the last wrench; the rock follows
  corrected  ///< the rock follows where the machine is heading; the machine takes the window with
             ///< the rock's answer
};

/// What one window did.
struct Window {
  std::int64_t step_index = 0;   ///< windows completed, this one included; 0: the start
  MachineState machine;          ///< committed, at the window's end
  RockState rock;                ///< at the window's end
  std::vector<Twist> V_WB_wall;  ///< the constant twist each wall moved with
  double rock_work_J = 0;        ///< done by the rock on the walls, as the rock side saw it
  double machine_work_J = 0;     ///< done by the held wrench on the machine's bodies
};

/// A wall at the end of a window, as the rock left it.
struct WallState {
  Pose X_WB;
  Twist V_WB_W;  ///< the constant one it moved with in the window
  Wrench load;   ///< on it at the window's last DEM step
};

/// Where a coupling stands between two windows: all it needs to go on from there.
struct CouplingState {
  std::int64_t step_index = 0;  ///< windows completed
  std::int64_t dem_step = 0;    ///< DEM steps completed
  std::vector<Wrench> held;     ///< by the machine, into the next window
  std::vector<WallState> walls;
};

/// Steps a machine and a rock through windows, and counts them. Both only go forward. The
/// difference of the two works of a window is energy the coupling made (positive: the machine got
/// more than the rock gave).
class Coupling {
 public:
  Coupling(Machine& machine, Rock& rock, Scheme scheme);

  /// Puts the walls where the machine is.
  Window start();

  /// Continues from a checkpoint. The machine has loaded its own; the rock was started from its
  /// own.
  void resume(CouplingState state);

  /// Begins a window of n_steps DEM steps; `finish` comes next. The rock steps between the two.
  void begin(std::int64_t n_steps);

  /// Ends it. \param n_next  DEM steps of the window that follows; 0: none does
  Window finish(std::int64_t n_next);

  const CouplingState& state() const { return state_; }
  const MachineState& machine_state() const { return machine_state_; }
  std::int64_t t_ns() const { return state_.dem_step * dt_ns_; }

 private:
  Machine& machine_;
  Rock& rock_;
  Scheme scheme_;
  std::int64_t dt_ns_;
  CouplingState state_;
  MachineState machine_state_;
  std::int64_t next_ns_ = 0;    ///< what machine_state_ was extrapolated to
  std::int64_t under_way_ = 0;  ///< DEM steps of the window that has begun
  MachineState stepped_;        ///< serial: the machine at its end
};

}  // namespace dipper::core
