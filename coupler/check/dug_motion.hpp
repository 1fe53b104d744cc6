// The motion that the warnings of a shovel's case judge.
#pragma once

#include <string>

#include "coupler/case/case.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

struct DugMotion {
  machine::Motion motion;
  std::string none;  ///< why an operator who plans finds no dig; empty: he does, or none plans
};

/// machine.motion. Where an operator plans: his first pass on the bench as the case makes it, or
/// machine.motion where he finds no dig there. Of a case without findings.
DugMotion dug_motion(const cases::Case& c);

}  // namespace dipper::check
