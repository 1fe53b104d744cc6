#include "coupler/cli/replay_command.hpp"

#include <fmt/format.h>

#include <memory>

#include "common/case_lines.hpp"
#include "common/manifest.hpp"
#include "common/writable_folder.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/check/check.hpp"
#include "coupler/cli/own_network.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/result/observed.hpp"
#include "coupler/run/machine_replay.hpp"
#include "coupler/run/replay.hpp"

namespace dipper::cli {
namespace {

struct ReplayOptions {
  std::string folder, out, case_folder;
  std::string side = "dem";
  std::vector<std::string> set;
};

/// A change that needs other rock is a finding; for a change of the dipper's path the answer is of
/// first order, and the command says so.
std::vector<Finding> weigh_changes(const std::string& folder, const cases::Case& changed,
                                   Reporter& reporter) {
  std::vector<Finding> findings;
  const CaseLines before = CaseLines::read(std::filesystem::path(folder) / "case.txt");
  for (const CaseLine& line : CaseLines(changed.text)) {
    const CaseLine* was = before.find(line.key);
    if (was == nullptr || was->value == line.value) continue;
    const cases::Affects affects = cases::spec_of(line.key)->affects;
    if (affects == cases::Affects::settling)
      findings.push_back({folder, 0, line.key, "changes the pile, which takes a new run"});
    else if (affects == cases::Affects::dig)
      reporter.line(fmt::format(
          "{} also changes the surface that the rock touches: the answer is first-order",
          line.key));
  }
  return findings;
}

int observe_another_machine(const ReplayOptions& o, Reporter& reporter) {
  if (o.side != "mbs" || o.out.empty()) {
    throw CLI::ValidationError("--set", "replays a changed machine: it needs --side mbs and --out");
  }
  std::vector<Finding> findings;
  const cases::Case changed = run::case_of_run(
      o.folder, o.case_folder, overrides_of(o.set, "effects.crowd_friction=100"), findings);
  if (findings.empty()) findings = check::check_case(changed);
  if (findings.empty() && changed.machine.drives == machine::DriveMode::limited) {
    findings.push_back(
        {o.folder, 0, "machine.drives",
         "is limited: a changed machine moves differently, so the recorded rock forces "
         "do not apply; run the case instead"});
  }
  if (findings.empty() && changed.machine.operated_by == cases::OperatorKind::plan) {
    findings.push_back({o.folder, 0, "machine.operator",
                        "is plan: the motion is not in the case, and with another machine it would "
                        "be another; run the case instead"});
  }
  if (findings.empty()) findings = weigh_changes(o.folder, changed, reporter);
  for (const Finding& f : findings) reporter.error(to_string(f));
  if (!findings.empty()) return 2;
  result::require_no_measured(o.out);
  make_writable(o.out);
  enter_own_network(reporter);
  run::observe_changed_machine(o.folder, changed, o.out);
  return 0;
}

int replay(const ReplayOptions& o, Reporter& reporter) {
  require_undamaged(o.folder);
  if (!o.set.empty()) return observe_another_machine(o, reporter);
  if (!o.case_folder.empty()) throw CLI::ValidationError("--case", "goes with --set");
  if (!o.out.empty()) throw CLI::ValidationError("--out", "goes with --set");
  enter_own_network(reporter);
  const run::ReplayResult r = run::replay(o.folder, o.side);
  reporter.line(
      fmt::format("{}: {} requests of {} segment{} asked again in {:.1f} s; the paired run took "
                  "{:.1f} s over them "
                  "({:.3f} times as long)",
                  o.side, r.requests, r.segments, r.segments == 1 ? "" : "s", r.wall_s,
                  r.recorded_wall_s, r.recorded_wall_s / r.wall_s));
  reporter.line(r.different == 0
                    ? "every answer equals the recorded one, bit for bit"
                    : fmt::format("{} answers differ: force by up to {:.3g} N, position by up to "
                                  "{:.3g} m",
                                  r.different, r.force_N, r.position_m));
  return r.different == 0 ? 0 : 3;
}

}  // namespace

Command add_replay_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<ReplayOptions>();
  auto* sub =
      app.add_subcommand("replay", "run the rock or the machine again, against a recording");
  sub->footer(
      "Shows whether a side gives the same answers again, to the bit, or what forces another "
      "machine would have had. Example:\n  dipper replay runs/quick --side dem");
  sub->add_option("DIR", o->folder, "a run's folder")->required()->check(CLI::ExistingDirectory);
  sub->add_option(
      "--set", o->set,
      "KEY=VALUE: replay a changed machine and observe it into --out (with --side mbs)");
  sub->add_option("--out", o->out, "folder for the observation of a changed machine");
  sub->add_option("--case", o->case_folder, "the run's case, if its folder has moved")
      ->check(CLI::ExistingDirectory);
  sub->add_option("--side", o->side, "the side to run: dem or mbs")
      ->check(CLI::IsMember({"dem", "mbs"}))
      ->capture_default_str();
  return {sub, [o, &reporter] { return replay(*o, reporter); }};
}

}  // namespace dipper::cli
