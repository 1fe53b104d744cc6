#include "coupler/cli/motion_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/draft_file.hpp"
#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "common/yaml_tree.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/cli/output_file.hpp"
#include "coupler/cli/preview_command.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/dry/dry_run.hpp"
#include "coupler/launch/interrupt.hpp"
#include "machine/motion_plan_file.hpp"
#include "machine/motion_row.hpp"
#include "machine/timed_path.hpp"

namespace dipper::cli {
namespace fs = std::filesystem;
namespace {

struct MotionOptions {
  std::string folder, path, plan, out, page;
  std::vector<std::string> set;
};

/// The first pass of an operator who plans, on the bench as the case makes it.
std::string chosen_rows(const cases::Case& c, const fs::path& file, Reporter& reporter) {
  const machine::DigPlanner planner = deck::dig_planner(c, file);
  const machine::DigDecision decision = deck::first_dig(c, planner, planner.start());
  if (decision.chosen < 0) throw InputError({{file, 0, "choose", decision.reason}});
  reporter.line(decision.reason);
  return decision.rows;
}

fs::path plan_of(const MotionOptions& o, const cases::Case& c) {
  if (!o.plan.empty()) return o.plan;
  return c.machine.plan.empty() ? c.folder / "plan.yaml" : c.machine.plan;
}

/// The motion may replace the case's own, and no other file that is read.
void require_outputs(const MotionOptions& o, const cases::Case& c, const fs::path& out,
                     const fs::path& page) {
  std::vector<fs::path> inputs = inputs_of(c);
  require_output(page, "--page", inputs);
  inputs.erase(std::remove(inputs.begin(), inputs.end(), c.machine.motion), inputs.end());
  inputs.push_back(o.path.empty() ? plan_of(o, c) : fs::path(o.path));
  if (fs::weakly_canonical(out) == fs::weakly_canonical(page))
    throw InputError({{out, 0, "--out", "is the file of --page, too; name another file"}});
  require_output(out, "--out", inputs);
}

std::string planned_rows(const MotionOptions& o, const cases::Case& c,
                         const machine::MachineData& data, const machine::ShovelKinematics& shovel,
                         const fs::path& out, const fs::path& page, Reporter& reporter) {
  const fs::path file = plan_of(o, c);
  const machine::PlanFile plan =
      machine::read_plan(file, data, shovel, [&](const std::string& name, double heading_rad) {
        if (name == "pile") return deck::bench_along_boom(c, heading_rad);
        const fs::path section = file.parent_path() / name;
        require_output(out, "--out", {section});
        require_output(page, "--page", {section});
        return cases::read_outline(section);
      });
  return fmt::format(
      "# {}\n# Made of {} by dipper motion.\n{}{}", plan.source, file.filename().string(),
      machine::kMotionHead,
      plan.choice ? chosen_rows(c, file, reporter) : machine::motion_rows(plan.plan, shovel));
}

std::string rows_along(const machine::TimedPath& path, const fs::path& file,
                       const machine::ShovelKinematics& shovel) {
  return fmt::format("# Made of {} by dipper motion.\n{}{}", file.filename().string(),
                     machine::kMotionHead, machine::motion_rows(path, shovel));
}

/// Reports where a motion exceeds the machine's limits; returns whether it does.
bool beyond_limits(const machine::Motion& motion, const machine::ShovelKinematics& shovel,
                   const std::string& from, Reporter& reporter) {
  const std::vector<std::string> beyond = shovel.check(motion);
  for (const std::string& what : beyond) reporter.error(from + ": " + what);
  return !beyond.empty();
}

void report_times(const machine::TimedPath& path, Reporter& reporter) {
  std::string times;
  for (const machine::PathPoint& p : path.points) times += fmt::format(" {:.1f}", p.t_s);
  reporter.line(fmt::format("the points are reached at{} s", times));
}

int motion_command(const MotionOptions& o, Reporter& reporter) {
  launch::catch_interrupts();
  std::vector<cases::Override> set = overrides_of(o.set, "pile.height_m=9");
  std::vector<Finding> findings;
  const cases::Case c = cases::load_case(o.folder, set, findings);
  if (!findings.empty()) throw InputError(std::move(findings));
  dry::require_drives(c);
  const machine::MachineData data = machine::load_machine(c.machine.model);
  Pose X_W0;
  X_W0.p = c.machine.base_position_m;
  const machine::ShovelKinematics shovel(data, X_W0, radians(c.machine.rake_angle_deg));

  const fs::path out = o.out.empty() ? c.machine.motion : fs::path(o.out);
  const fs::path page = o.page.empty() ? fs::path(c.name + "-motion.html") : fs::path(o.page);
  require_outputs(o, c, out, page);

  std::string text;
  if (o.path.empty()) {
    text = planned_rows(o, c, data, shovel, out, page, reporter);
  } else {
    const machine::TimedPath path = machine::read_timed_path(o.path);
    report_times(path, reporter);
    text = rows_along(path, o.path, shovel);
  }
  const machine::Motion motion = machine::Motion::parse(text, out.string());
  if (beyond_limits(motion, shovel, o.path.empty() ? "the plan" : o.path, reporter)) return 2;

  const DraftFile draft(fs::absolute(out));
  if (!(std::ofstream(draft.path()) << text).flush())
    throw InputError({{fs::absolute(out), 0, "", "cannot be written"}});
  set.push_back({"machine.motion", in_quotes(draft.path().string())});
  set.push_back({"machine.operator", "motion"});  // the page shows this very motion
  auto sound = check::checked_case(o.folder, set, reporter);
  if (!sound) return 2;
  const int status = write_dry_page(*sound, dry::RockModel::estimate, page, reporter);
  if (status != 0) return status;
  draft.keep();
  reporter.line(fmt::format("{}: {:.1f} s", out.string(), seconds(motion.end_ns())));
  return 0;
}

}  // namespace

Command add_motion_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<MotionOptions>();
  auto* sub = app.add_subcommand("motion", "motion.csv from a plan, or from a path of the teeth");
  sub->footer(
      "Checks rope, crowd, door, speeds and the ground, and writes nothing where the machine "
      "cannot follow. Then runs the motion against an estimate of the rock, warns of drives "
      "beyond their limits, and writes a page with the path through the pile (docs/motion.md). "
      "Examples:\n"
      "  dipper motion cases/aitik\n  dipper motion cases/quick docs/data/path.csv --out mine.csv");
  sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
  auto* path = sub->add_option("PATH", o->path, "CSV of points of the teeth with speeds");
  sub->add_option("--plan", o->plan,
                  "the plan (default: machine.plan, else plan.yaml in the case's folder)")
      ->excludes(path);
  sub->add_option("--out", o->out, "the file to write (default: the case's machine.motion)");
  sub->add_option("--page", o->page, "the page (default: NAME-motion.html)");
  sub->add_option("--set", o->set, "KEY=VALUE: overrides the case");
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
