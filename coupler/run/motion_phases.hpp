// The passes and phases of a motion, before it is run.
#pragma once

#include <string>
#include <vector>

#include "analysis/signals/phases.hpp"
#include "machine/motion.hpp"

namespace dipper::run {

/// A motion's passes and their phases, by the same rules as `dipper phases` applies to a log.
class MotionPhases {
 public:
  explicit MotionPhases(const machine::Motion& motion);

  /// "2 fill": pass and phase at a time of the motion; "" before its start.
  std::string at(double t_s) const;

 private:
  struct InPass {
    int pass;  ///< from 1
    analysis::signals::Phase phase;
  };
  std::vector<InPass> phases_;
};

}  // namespace dipper::run
