#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/machine_geometry.hpp"
#include "machine/motion_plan_file.hpp"

namespace fs = std::filesystem;

namespace dipper::check {
namespace {

template <class Load>
auto load_reported(const cases::Case& c, const std::string& key, const fs::path& file,
                   const Load& load, Findings& findings) -> std::optional<decltype(load(file))> {
  if (!file_exists(c, key, file, findings)) return std::nullopt;
  try {
    return load(file);
  } catch (const InputError& e) {
    cases::add_file_findings(c, key, e, findings);
  }
  return std::nullopt;
}

// Limited drives reach each point later than the motion says, and an operator who plans makes
// another motion, so its times fix no event.
void check_times_of_motion(const cases::Case& c, Findings& findings) {
  const bool plans = c.machine.operated_by == cases::OperatorKind::plan;
  if (!plans && c.machine.drives != machine::DriveMode::limited) return;
  if (c.collapse.height_m > 0 && c.collapse.at_s == 0) {
    findings.push_back(
        cases::finding_at(c, "collapse.at_s",
                          fmt::format("{} not keep the motion's times; write a time",
                                      plans ? "an operator who plans does" : "limited drives do")));
  }
}

constexpr double kShortest_s = 1;  // in which no drive goes far
constexpr double kFar_m = 1;       // of the hoist

// The machine stands as in the first row when the run begins.
void check_start_of_motion(const cases::Case& c, const machine::Motion& motion,
                           Findings& findings) {
  if (motion.start_ns() == 0) return;
  findings.push_back({c.machine.motion, 0, "time_s",
                      fmt::format("the first row is at {:g} s, and a run begins at 0 s; count the "
                                  "times from the first row",
                                  seconds(motion.start_ns()))});
}

// False, and a finding, for a motion in hours or minutes.
bool check_length_of_motion(const cases::Case& c, const machine::Motion& motion,
                            Findings& findings) {
  const double span_s = seconds(motion.end_ns() - motion.start_ns());
  if (span_s >= kShortest_s) return true;
  double low = INFINITY, high = -INFINITY;
  for (std::int64_t t = motion.start_ns(); t < motion.end_ns();
       t = std::min(motion.next_row_ns(t), motion.end_ns())) {
    low = std::min(low, motion.value(t).hoist);
    high = std::max(high, motion.value(t).hoist);
  }
  if (high - low < kFar_m) return true;
  findings.push_back(
      {c.machine.motion, 0, "machine.motion",
       fmt::format("the whole motion takes {:.3g} s, in which the hoist moves {:.3g} m: is time_s "
                   "in hours or minutes? write it in s",
                   span_s, high - low)});
  return false;
}

// The floor is cleaned only when a return without rock ends.
void check_clean_floor(const cases::Case& c, Findings& findings) {
  if (c.pile.clean_floor_to_x_m == 0 || !c.machine.contact_on_return) return;
  findings.push_back(
      cases::finding_at(c, "pile.clean_floor_to_x_m",
                        "needs a return without rock; write machine.contact_on_return: off"));
}

constexpr double kLeastTurn_deg = 5;  // from the face to the truck, and of a door that opens

// An operator who plans has a plan to choose from.
void check_operator(const cases::Case& c, const machine::MachineData& machine,
                    const machine::ShovelKinematics& shovel, Findings& findings) {
  const bool given = !c.machine.plan.empty();
  if (given && !file_exists(c, "machine.plan", c.machine.plan, findings)) return;
  if (c.machine.operated_by != cases::OperatorKind::plan) return;
  if (!given) {
    findings.push_back(
        cases::finding_at(c, "machine.operator",
                          "plan needs machine.plan: a plan.yaml with `choose` (docs/operator.md)"));
    return;
  }
  try {
    const machine::PlanFile plan = machine::read_plan(
        c.machine.plan, machine, shovel, [&](const std::string&, double heading_rad) {
          return deck::bench_along_boom(c, heading_rad);
        });
    if (!plan.choice)
      findings.push_back({c.machine.plan, 0, "machine.plan",
                          "has passes; operator plan needs `choose` in their place "
                          "(docs/operator.md)"});
    else if (!plan.plan.returns)
      findings.push_back({c.machine.plan, 0, "machine.plan",
                          "has no return from the truck; operator plan needs back, "
                          "swing_back, door_close and lower_deg_m"});
    for (const auto& [key, angle] :
         {std::pair{"dump_deg", plan.plan.dump_rad}, std::pair{"door_deg", plan.plan.door_rad}})
      if (std::abs(angle) < radians(kLeastTurn_deg))
        findings.push_back({c.machine.plan, 0, key,
                            fmt::format("is {:g} degrees, less than {:g}: in rad, perhaps?",
                                        degrees(angle), kLeastTurn_deg)});
  } catch (const InputError& e) {
    cases::add_file_findings(c, "machine.plan", e, findings);
  }
}

constexpr double kFeet =
    2.5;  // times the machine's dipper: no dipper's mesh in m, 3.3 for one in ft

// Whether the dipper's mesh is in feet, by the machine's dipper; else nothing.
std::optional<Finding> dipper_in_feet(const cases::Case& c, const machine::MachineData& machine,
                                      const std::map<std::string, mesh::TriangleMesh>& bodies) {
  const auto found = bodies.find("dipper");
  if (found == bodies.end()) return std::nullopt;
  const double longest = mesh::bounding_box(found->second).sides_m().maxCoeff();
  const double wanted = machine.dipper.inside.maxCoeff();
  if (longest < kFeet * wanted) return std::nullopt;
  return cases::finding_at(
      c, "bodies.dipper",
      fmt::format(
          "the mesh is {:.4g} m long and leaves the domain, and the machine's dipper is {:g} "
          "m: in ft, perhaps? {:.4g} ft are {:.4g} m, scale it by 0.3048",
          longest, wanted, longest, 0.3048 * longest));
}

}  // namespace

std::optional<machine::Motion> check_motion(const cases::Case& c,
                                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                                            Findings& findings) {
  std::map<std::string, mesh::TriangleMesh> known = bodies;
  for (const auto& body : c.bodies) {
    if (body.first == "dipper" || body.first == "door") continue;
    known.erase(body.first);
    findings.push_back(cases::finding_at(
        c, "bodies." + body.first,
        "the machine has no such body; it has dipper and door. For bodies of your "
        "own: machine.kind: poses (docs/poses.md)"));
  }
  if (!c.bodies.count("dipper"))
    findings.push_back(cases::finding_at(c, "bodies.dipper", "missing key; it is what digs"));
  if (!c.bodies.count("door"))
    findings.push_back(
        cases::finding_at(c, "bodies.door", "missing key; without it the dipper holds nothing"));

  if (const double z = c.machine.base_position_m.z(); z != 0)
    findings.push_back(
        cases::finding_at(c, "machine.base_position_m",
                          fmt::format("z is {:g} m; machine and rock stand on the same ground, "
                                      "z = 0: write 0",
                                      z)));
  const auto machine =
      load_reported(c, "machine.model", c.machine.model, machine::load_machine, findings);
  auto motion =
      load_reported(c, "machine.motion", c.machine.motion, &machine::Motion::load, findings);
  if (machine) {
    const auto faults = machine::geometry_faults(*machine, radians(c.machine.rake_angle_deg));
    for (const std::string& fault : faults)
      findings.push_back({c.machine.model, 0, "machine.model", fault});
    if (!faults.empty()) return motion;
  }
  if (motion) check_start_of_motion(c, *motion, findings);
  if (!machine || !motion || !check_length_of_motion(c, *motion, findings)) return motion;

  const Pose X_W0{Quaterniond::Identity(), c.machine.base_position_m};
  const machine::ShovelKinematics shovel(*machine, X_W0, radians(c.machine.rake_angle_deg));
  for (const std::string& message : shovel.check(*motion)) {
    findings.push_back({c.machine.motion, 0, "machine.motion", message});
  }
  Findings outside;
  check_bodies_in_domain(
      c,
      [&](const std::string& body, std::int64_t t_ns) -> std::optional<Pose> {
        try {
          const machine::ShovelPose pose = shovel.pose(motion->value(t_ns));
          return body == "door" ? pose.X_WD : pose.X_WB;
        } catch (
            const std::domain_error&) {  // beyond the ropes: ShovelKinematics::check reports it
          return std::nullopt;
        }
      },
      motion->start_ns(), motion->end_ns(), known, outside);
  if (const auto feet = dipper_in_feet(c, *machine, known); feet && !outside.empty())
    findings.push_back(*feet);
  else
    findings.insert(findings.end(), outside.begin(), outside.end());
  check_operator(c, *machine, shovel, findings);
  check_times_of_motion(c, findings);
  check_clean_floor(c, findings);
  check_collapse(c, shovel, *motion, known, findings);
  return motion;
}

void check_windows(const cases::Case& c, std::int64_t end_ns, Findings& findings) {
  // Time is a whole number of nanoseconds and of steps; a step between two would drift from it.
  const double step_ns = c.dem.timestep_s * 1e9;
  if (std::abs(step_ns - std::round(step_ns)) > 1e-3 || step_ns < 0.5) {
    findings.push_back(cases::finding_at(
        c, "dem.timestep_s",
        fmt::format("{:g} is not a whole number of nanoseconds; write {:.9g}", c.dem.timestep_s,
                    std::max(1.0, std::floor(step_ns)) * 1e-9)));
  }
  const double end_s = c.end_s > 0 ? c.end_s : seconds(end_ns);
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  if (end_s < c.dem.timestep_s) {
    findings.push_back(cases::finding_at(
        c, "end_s",
        fmt::format("{:g} s is shorter than a DEM step, {:g} s", end_s, c.dem.timestep_s)));
  } else if (window_s > end_s) {
    findings.push_back(cases::finding_at(
        c, "coupling.sync_steps",
        fmt::format(
            "a sync step of {} DEM steps takes {:g} s, longer than the {:g} s simulated; write at "
            "most {:.0f}",
            c.coupling.sync_steps, window_s, end_s, std::floor(end_s / c.dem.timestep_s))));
  }
}

}  // namespace dipper::check
