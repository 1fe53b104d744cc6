#include "coupler/check/dug_motion.hpp"

#include <limits>

#include "common/angles.hpp"
#include "coupler/deck/bench_map.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion_row.hpp"

namespace dipper::check {

DugMotion dug_motion(const cases::Case& c) {
  if (c.machine.operated_by != cases::OperatorKind::plan)
    return {machine::Motion::load(c.machine.motion), ""};
  const machine::ShovelKinematics shovel(machine::load_machine(c.machine.model),
                                         {Quaterniond::Identity(), c.machine.base_position_m},
                                         radians(c.machine.rake_angle_deg));
  const machine::Drives begin = machine::Motion::load(c.machine.motion).value(0);
  machine::PassStart from;
  from.tip = shovel.teeth(begin);
  from.heading_rad = begin.swing;
  const machine::DigPlanner planner = deck::dig_planner(c, c.machine.plan);
  const machine::DigDecision first = planner.decide(deck::bench_map(c).on(planner.grid()), from,
                                                    c.op.least_fill * planner.facts().capacity_kg,
                                                    std::numeric_limits<double>::infinity());
  if (first.chosen < 0) return {machine::Motion::load(c.machine.motion), first.reason};
  return {machine::Motion::parse(machine::kMotionHead + first.rows, "the operator's first pass"),
          ""};
}

}  // namespace dipper::check
