#include "coupler/deck/dig_planner.hpp"

#include <limits>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/deck/bench_map.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/cut_ahead.hpp"
#include "machine/motion_plan_file.hpp"

namespace dipper::deck {

machine::DigFacts dig_facts(const cases::Case& c) {
  std::vector<Finding> findings;
  const cases::DipperFacts dipper = cases::read_dipper_facts(c, findings, "dipper");
  if (!findings.empty()) throw InputError(std::move(findings));
  machine::DigFacts f;
  f.bulk_density_kg_m3 = c.rock.bulk_density_kg_m3 * laden_density(c) / c.rock.density_kg_m3;
  f.capacity_kg = f.bulk_density_kg_m3 * dipper.struck_volume_m3;
  f.specific_resistance_Pa = machine::kSpecificResistance_Pa;
  f.load_B = 0.5 * (dipper.cavity.min_m + dipper.cavity.max_m);
  f.half_width_m = c.pile.width_m / 2;
  f.walls_from_x_m = pile_shape(c).toe_x_m;
  return f;
}

machine::DigPlanner dig_planner(const cases::Case& c, const std::filesystem::path& plan) {
  const machine::MachineData data = machine::load_machine(c.machine.model);
  const double rake = radians(c.machine.rake_angle_deg);
  const machine::ShovelKinematics shovel(data, {Quaterniond::Identity(), c.machine.base_position_m},
                                         rake);
  const machine::PlanFile file = machine::read_plan(
      plan, data, shovel,
      [&](const std::string&, double heading_rad) { return bench_along_boom(c, heading_rad); });
  if (!file.choice)
    throw InputError({{plan, 0, "choose",
                       "missing; operator plan needs the digs to choose from (docs/operator.md)"}});
  return {*file.choice, file.plan, dig_facts(c), data, c.machine.base_position_m, rake, c.op.goal};
}

machine::DigDecision first_dig(const cases::Case& c, const machine::DigPlanner& planner,
                               const machine::PassStart& from) {
  return planner.decide(bench_map(c).on(planner.grid()), from,
                        c.op.least_fill * planner.facts().capacity_kg,
                        std::numeric_limits<double>::infinity());
}

}  // namespace dipper::deck
