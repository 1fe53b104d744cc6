// The co-simulation step: who moves first, what is held, and what it costs in energy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"

namespace dipper::core {

enum class Scheme {
  serial,    ///< the machine takes the window with the last wrench; the rock follows
  corrected  ///< the machine predicts, the rock follows, the machine repeats with the new wrench
};
/// Throws std::invalid_argument for another word.
Scheme scheme_from(const std::string& word);

/// What one window did.
struct Window {
  std::int64_t step_index = 0;   ///< windows completed, this one included; 0: the start
  MachineState machine;          ///< committed, at the window's end
  RockState rock;                ///< at the window's end
  std::vector<Twist> V_WB_wall;  ///< the constant twist each wall moved with
  double rock_work_J = 0;        ///< done by the rock on the walls, as the rock side saw it
  double machine_work_J = 0;     ///< done by the held wrench on the machine's bodies
};

/// Steps a machine and a rock through windows. The difference of the two works of a window is
/// energy the coupling made (positive: the machine got more than the rock gave).
class Coupling {
 public:
  Coupling(Machine& machine, Rock& rock, Scheme scheme);

  /// Puts the walls where the machine is.
  Window start();

  /// Continues from a checkpoint: both sides have loaded theirs.
  void resume(std::int64_t step_index, std::int64_t dem_step, std::vector<Wrench> held,
              std::vector<Pose> X_WB_wall);

  /// One window of n_steps DEM steps.
  Window advance(std::int64_t n_steps);

  /// The wrench held into the next window; part of a checkpoint.
  const std::vector<Wrench>& held() const { return held_; }

 private:
  Machine& machine_;
  Rock& rock_;
  Scheme scheme_;
  std::int64_t dt_ns_;
  std::int64_t step_index_ = 0;
  std::int64_t dem_step_ = 0;
  MachineState machine_state_;
  std::vector<Pose> X_WB_wall_;
  std::vector<Wrench> held_;
};

}  // namespace dipper::core
