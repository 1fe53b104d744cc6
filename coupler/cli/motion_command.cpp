#include "coupler/cli/motion_command.hpp"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/motion_plan_file.hpp"

namespace dipper::cli {
namespace fs = std::filesystem;
namespace {

struct MotionOptions {
  std::string folder, plan, out;
  std::vector<std::string> set;
};

cases::Case load(const MotionOptions& o) {
  std::vector<Finding> findings;
  cases::Case c = cases::load_case(o.folder, overrides_of(o.set, "pile.height_m=9"), findings);
  if (!findings.empty()) throw InputError(std::move(findings));
  return c;
}

int motion_command(const MotionOptions& o, Reporter& reporter) {
  const cases::Case c = load(o);
  const fs::path plan_file = o.plan.empty() ? c.folder / "plan.yaml" : fs::path(o.plan);
  const fs::path out = o.out.empty() ? c.machine.motion : fs::path(o.out);
  const machine::MachineData data = machine::load_machine(c.machine.model);
  Pose X_W0;
  X_W0.p = c.machine.base_position_m;
  const machine::ShovelKinematics shovel(data, X_W0, radians(c.machine.rake_angle_deg));
  const machine::PlanFile plan =
      machine::read_plan(plan_file, data, shovel, [&](const std::string& name, double heading_rad) {
        return name == "pile" ? deck::bench_along_boom(c, heading_rad)
                              : cases::read_outline(plan_file.parent_path() / name);
      });
  std::string text = fmt::format("# {}\n# Made of {} by dipper motion.\n", plan.source,
                                 plan_file.filename().string());
  text += "time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + motion_rows(plan.plan, shovel);
  const std::vector<std::string> beyond =
      shovel.check(machine::Motion::parse(text, plan_file.string()));
  for (const std::string& what : beyond) reporter.error(plan_file.string() + ": " + what);
  if (!beyond.empty()) return 2;
  std::ofstream file(out);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + out.string());
  reporter.line(fmt::format("{}: {} passes, {:.1f} s", out.string(), plan.plan.passes.size(),
                            plan.plan.cycle_s * static_cast<double>(plan.plan.passes.size())));
  return 0;
}

}  // namespace

Command add_motion_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<MotionOptions>();
  auto* sub =
      app.add_subcommand("motion", "motion.csv of a plan: how the teeth go through the face");
  sub->footer(
      "Checked against rope, crowd, door, speeds and the ground; nothing is written where the "
      "machine cannot follow (docs/motion.md). Example:\n  dipper motion cases/aitik");
  sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
  sub->add_option("--plan", o->plan, "the plan; plan.yaml in the case's folder");
  sub->add_option("--out", o->out, "the curves; the case's machine.motion");
  sub->add_option("--set", o->set, "KEY=VALUE instead of what the case says");
  return {sub, [o, &reporter] {
            try {
              return motion_command(*o, reporter);
            } catch (const InputError& e) {
              reporter.error(e.what());
            } catch (const std::domain_error& e) {
              reporter.error(e.what());
            }
            return 2;
          }};
}

}  // namespace dipper::cli
