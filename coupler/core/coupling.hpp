// The co-simulation step: the order of the calls, the held wrench, and the energy error.
#pragma once

#include <cstdint>
#include <vector>

#include "coupler/core/server.hpp"

namespace dipper::core {

enum class Scheme {
  serial,    ///< the machine steps with the last wrench; the rock follows
  corrected  ///< the rock follows the machine's predicted motion; the machine steps with the rock's
             ///< answer
};

/// The result of one window.
struct Window {
  std::int64_t step_index = 0;  ///< windows completed, this one included; 0: the start
  MachineState machine;         ///< at the window's end, after its correction
  RockState rock;               ///< at the window's end
  double rock_work_J = 0;       ///< by the rock on the walls, by the rock side's wrench
  double machine_work_J = 0;    ///< by the held wrench on the machine's bodies
};

/// A wall at the end of a window.
struct WallState {
  Pose X_WB;
  Twist V_WB_W;  ///< constant twist in the window
  Wrench load;   ///< at the window's last DEM step
};

/// The state between two windows, complete for resuming.
struct CouplingState {
  std::int64_t step_index = 0;  ///< windows completed
  std::int64_t dem_step = 0;    ///< DEM steps completed
  std::vector<Wrench> held;     ///< by the machine, in the next window
  std::vector<WallState> walls;
};

/// Steps a machine and a rock through windows and counts them. Both only go forward. The difference
/// between the two works of a window is the coupling's energy error (positive: the machine received
/// more than the rock gave).
class Coupling {
 public:
  Coupling(Machine& machine, Rock& rock, Scheme scheme);

  /// Places the walls at the machine's bodies.
  Window start();

  /// Continues from a checkpoint. The machine has loaded its own; the rock process was started from
  /// its own.
  void resume(CouplingState state);

  /// Starts a window of n_steps DEM steps; `finish` must follow. The rock computes in between.
  void begin(std::int64_t n_steps);

  /// Ends the window. \param n_next  DEM steps of the next window; 0: there is none
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
  std::int64_t next_ns_ = 0;    ///< time to which machine_state_ is extrapolated
  std::int64_t under_way_ = 0;  ///< DEM steps of the started window
  MachineState stepped_;        ///< serial scheme: the machine at the window's end
};

}  // namespace dipper::core
