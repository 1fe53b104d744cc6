#include "coupler/check/dug_motion.hpp"

#include <utility>

#include "common/angles.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion_row.hpp"

namespace dipper::check {

DugMotion dug_motion(const cases::Case& c) {
  machine::Motion motion = machine::Motion::load(c.machine.motion);
  if (c.machine.operated_by != cases::OperatorKind::plan) return {std::move(motion), ""};
  const machine::ShovelKinematics shovel(machine::load_machine(c.machine.model),
                                         {Quaterniond::Identity(), c.machine.base_position_m},
                                         radians(c.machine.rake_angle_deg));
  const machine::Drives begin = motion.value(0);
  machine::PassStart from;
  from.tip = shovel.teeth(begin);
  from.heading_rad = begin.swing;
  const machine::DigPlanner planner = deck::dig_planner(c, c.machine.plan);
  const machine::DigDecision first = deck::first_dig(c, planner, from);
  if (first.chosen < 0) return {std::move(motion), first.reason};
  return {machine::Motion::parse(machine::kMotionHead + first.rows, "the operator's first pass"),
          ""};
}

}  // namespace dipper::check
