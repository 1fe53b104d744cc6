#include "coupler/dry/dry_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/record/record.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/deck/bench_map.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "coupler/dry/estimated_rock.hpp"
#include "coupler/dry/machine_limits.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/operate/operated_machine.hpp"
#include "coupler/result/drive_limits_met.hpp"
#include "coupler/result/operator_summary.hpp"
#include "coupler/result/pass_rows.hpp"
#include "coupler/run/lone_machine.hpp"
#include "coupler/run/pass_desk.hpp"
#include "coupler/run/preparation.hpp"
#include "coupler/run/progress.hpp"
#include "coupler/run/run_record.hpp"
#include "coupler/run/same_run.hpp"
#include "coupler/run/stepper.hpp"
#include "coupler/run/timed_rock.hpp"
#include "coupler/sides/dipper_layers.hpp"
#include "coupler/sides/sides_setup.hpp"
#include "coupler/transport/lcm_transport.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::dry {
namespace fs = std::filesystem;
namespace {

using json = nlohmann::ordered_json;

constexpr double kSummaryTrim = 1e-3;  // m: of the faces' points, as fine as a page draws

setup::PeerConfig machine_config(const cases::Case& c, const result::RunFolder& folder,
                                 bool program_drives) {
  setup::PeerConfig config;
  config.lcm_url = transport::kLcmUrl;
  config.secret = setup::random_secret();
  config.identity.run_id = folder.root().filename().string();
  config.identity.case_hash = cases::case_hash(c);
  config.checkpoints = folder.checkpoints();
  config.settings = to_json(sides::machine_setup(
      c, sides::dipper_layers(c, sides::read_mesh_facts(c).dipper.cavity), program_drives));
  return config;
}

/// What a page of the run is drawn from, as a paired run leaves it: the deck with its walls and
/// bench, and the regions in which rock is weighed.
void write_scene(const cases::Case& c, const result::RunFolder& folder) {
  deck::write_deck(c, c.rock.shape_folder, folder.deck());
  const sides::MeshFacts facts = sides::read_mesh_facts(c);
  run::write_scales(folder,
                    sides::rock_setup(c, facts, folder.deck(), folder.dumps(), folder.logs(),
                                      fs::path(), std::nullopt),
                    facts.dipper);
}

/// Steps to the end of the motion, or until interrupted. Whether the end is reached.
bool step_through(const cases::Case& c, EstimatedRock& estimated, core::Machine& lone,
                  const result::RunFolder& folder, const std::optional<operate::Program>& program,
                  Reporter& reporter) {
  run::TimedRock rock(estimated);
  std::optional<operate::OperatedMachine> operated;
  if (program)
    operated.emplace(
        lone, run::operated(c, *program, folder, ""), false,
        operate::RockTruth{rock.info(), [&]() -> const core::RockState& { return rock.last(); }});
  core::Machine& machine = operated ? *operated : lone;
  core::Coupling coupling(machine, rock, c.coupling.scheme);
  const run::RunEnd end = run::run_end(c, program.has_value());
  run::RunRecord record(folder.record(), machine.info(), rock.info(),
                        run::record_attributes(c, machine.info(), rock.info(), program),
                        run::RecordPosition{});
  run::Stepper stepper(coupling, c.coupling.sync_steps, end.step);
  run::Progress progress(reporter, c, end, machine.info(), rock.info());
  run::end_with_path(stepper, end, machine.info());
  if (operated) stepper.end_when([&](const core::MachineState&) { return operated->done(); });
  stepper.add(record);
  stepper.add(progress);
  std::optional<run::PassDesk> desk;
  if (c.machine.operated_by == cases::OperatorKind::plan && !operated) {
    desk.emplace(c, run::PassDesk::Sides{machine, rock, machine.info(), rock.info()},
                 folder.decisions(), nullptr, reporter);
    stepper.add(*desk);
    stepper.end_when([&](const core::MachineState&) { return desk->finished(); });
    progress.follow([&] { return run::Progress::Passes{desk->passes(), desk->expected_end_s()}; });
  }
  bool complete = false;
  try {
    stepper.start();
    complete = stepper.run([] { return launch::interrupts() > 0; });
  } catch (const transport::PeerError& e) {
    throw std::runtime_error(fmt::format("the {} side failed at t = {:.4f} s: {}", e.side,
                                         seconds(coupling.t_ns()), e.what()));
  }
  if (operated) operated->end();
  record.flush();
  return complete;
}

json describe(const std::vector<LimitUse>& uses) {
  json out = json::array();
  for (const LimitUse& u : uses)
    out.push_back({{"name", u.name},
                   {"unit", u.unit},
                   {"most", u.most},
                   {"at_s", u.at_s},
                   {"limit", u.limit},
                   {"over_s", u.over_s}});
  return out;
}

/// When the shovel starts to face the rock in a pass, also if it then meets none.
double faces_rock_s(const json& pass) {
  for (const json& phase : pass.at("phases"))
    if (phase.at("phase") == word(analysis::signals::PhaseName::penetrate))
      return phase.at("t_start_s");
  return pass.at("t_dig_s");
}

/// The bench in the plane of the boom where each pass digs: x from the swing axis.
json faces(const cases::Case& c, const json& passes, const fs::path& record) {
  const auto time_s = record::read_channel(record, "time_s"),
             swing = record::read_channel(record, "machine/swing");
  json out = json::array();
  for (const json& pass : passes) {
    const auto dig = std::lower_bound(time_s.begin(), time_s.end(), faces_rock_s(pass));
    const double heading = swing.at(static_cast<std::size_t>(dig - time_s.begin()));
    json face = {{"pass", pass.at("pass")}, {"out_m", json::array()}, {"up_m", json::array()}};
    for (const auto& p : deck::bench_along_boom(c, heading)) {
      face["out_m"].push_back(std::round(p.x() / kSummaryTrim) * kSummaryTrim);
      face["up_m"].push_back(std::round(p.y() / kSummaryTrim) * kSummaryTrim);
    }
    out.push_back(std::move(face));
  }
  return out;
}

void report_limits(const std::vector<LimitUse>& uses, Reporter& reporter) {
  for (const LimitUse& u : uses)
    if (u.over_s > 0)
      reporter.line(
          fmt::format("warning: {} reaches {:.3g} {} at {:.2f} s, the machine's limit is {:.3g}; "
                      "above it for {:.2f} s",
                      u.name, u.most, u.unit, u.at_s, u.limit, u.over_s));
}

json summarise(const cases::Case& c, RockModel rock, const result::RunFolder& folder,
               const std::vector<LimitUse>& limits, double mbs_cpu_s) {
  const auto time_s = record::read_channel(folder.record(), "time_s");
  const double sim_s = time_s.empty() ? 0 : time_s.back();
  const json passes = result::pass_rows(c, folder);
  return {
      {"case", c.name},
      {"seed", c.seed},
      {"version", version()},
      {"rock_model", rock == RockModel::none ? "none" : "estimate"},
      {"passes", passes},
      {"limits", describe(limits)},
      {"faces", faces(c, passes, folder.record())},
      {"base_m", {c.machine.base_position_m.x(), c.machine.base_position_m.y()}},
      {"mbs", {{"cpu_s", mbs_cpu_s}, {"realtime_factor", mbs_cpu_s > 0 ? sim_s / mbs_cpu_s : 0.0}}},
      {"sim_s", sim_s}};
}

}  // namespace

void require_drives(const cases::Case& c) {
  if (c.machine.kind == cases::MachineKind::shovel) return;
  throw InputError({cases::finding_at(
      c, "machine.kind",
      "a run without rock shows the drives, and a case of poses has none; run it with rock")});
}

run::RunStatus dry_run(const cases::Case& c, RockModel rock, const result::RunFolder& folder,
                       const std::optional<operate::Program>& program, Reporter& reporter) {
  DiggingEstimate estimate = digging_estimate(c);
  estimate.there_is_rock = rock == RockModel::estimate;
  run::write_identity(folder.root(), c);
  write_scene(c, folder);
  bool complete = false;
  double mbs_cpu_s = 0;
  const auto failed = [&] {  // a folder with a record counts as a run
    fs::remove(folder.record());
    return run::RunStatus::failed;
  };
  try {
    EstimatedRock estimated(deck::bench_map(c), estimate, c.dem.timestep_s);
    run::LoneMachine lone(machine_config(c, folder, program.has_value()), folder.logs());
    complete = step_through(c, estimated, lone.machine(), folder, program, reporter);
    mbs_cpu_s = lone.cpu_s();
  } catch (const launch::Interrupted&) {
  } catch (const transport::PeerError& e) {
    reporter.error(fmt::format("the {} side failed as it started: {}", e.side, e.what()));
    return failed();
  } catch (const std::exception& e) {
    reporter.error(e.what());
    return failed();
  }
  for (const fs::path& unused : {folder.dumps(), folder.checkpoints()}) fs::remove(unused);
  if (!complete) {
    fs::remove(folder.record());
    reporter.error("interrupted; the same command starts it again");
    return run::RunStatus::interrupted;
  }
  const std::vector<LimitUse> limits =
      limit_uses(folder.record(), machine::load_machine(c.machine.model));
  json summary = summarise(c, rock, folder, limits, mbs_cpu_s);
  summary["status"] = "complete";
  if (program) summary["operator"] = program->command;
  result::report_drives(c, folder.record(), summary, reporter);
  if (json planned = result::operator_summary(c, folder); !planned.is_null())
    summary["operator"] = planned;
  write_text(folder.summary(), summary.dump(2) + '\n');
  if (rock == RockModel::estimate) result::report_passes(summary.at("passes"), reporter);
  report_limits(limits, reporter);
  return run::RunStatus::complete;
}

}  // namespace dipper::dry
