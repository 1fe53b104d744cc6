#include "coupler/cli/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "analysis/report/dry_page.hpp"
#include "common/cache_folder.hpp"
#include "common/input_error.hpp"
#include "common/installation.hpp"
#include "common/manifest.hpp"
#include "common/resolved_path.hpp"
#include "common/writable_folder.hpp"
#include "coupler/check/checked_case.hpp"
#include "coupler/check/cost_estimate.hpp"
#include "coupler/cli/number_option.hpp"
#include "coupler/cli/own_network.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/deck/liggghts_path.hpp"
#include "coupler/dry/dry_run.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/rank_places.hpp"
#include "coupler/operate/conversation.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/paired_run.hpp"
#include "coupler/run/preparation.hpp"
#include "coupler/run/same_run.hpp"
#include "coupler/run/settings.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string folder, out;
  std::vector<std::string> set;
  int ranks = 0;
  std::optional<long> seed;
  std::optional<std::string> mpirun;  ///< its options
  bool resume = false;
  std::string no_rock;                 ///< "none" or "estimate"; empty: there is rock
  std::optional<std::string> program;  ///< that drives the machine
  bool truth = false;                  ///< it sees the simulation's
};

/// The folder given, or runs/NAME, runs/NAME-2, ...: results are never overwritten.
fs::path run_folder(const RunOptions& o) {
  if (!o.out.empty()) return o.out;
  const std::string name = resolved(o.folder).filename().string();
  fs::path folder = fs::path("runs") / name;
  for (int k = 2; !o.resume && fs::exists(folder); ++k) {
    folder = fs::path("runs") / fmt::format("{}-{}", name, k);
  }
  return folder;
}

double resumed_from_s(const result::RunFolder& folder, const cases::Case& c) {
  const auto last = run::last_checkpoint(folder.checkpoints());
  return last ? static_cast<double>(last->coupling.dem_step) * c.dem.timestep_s : 0;
}

// The settings of a run that are no keys of its case, which has a section `operator`.
constexpr const char* kMpirun = "--mpirun";
constexpr const char* kOperator = "--operator";
constexpr const char* kOperatorFolder = "--operator-folder";
constexpr const char* kOperatorTruth = "--operator-truth";

/// Such a setting: the value given, else the one kept, which is removed from the settings.
std::string take(const char* name, const std::optional<std::string>& asked,
                 std::vector<cases::Override>& kept) {
  std::string text = asked.value_or("");
  const auto is_it = [&](const cases::Override& o) { return o.key == name; };
  const auto found = std::find_if(kept.begin(), kept.end(), is_it);
  if (found != kept.end()) {
    if (!asked) text = found->value;
    kept.erase(found);
  }
  std::replace(text.begin(), text.end(), '\n', ' ');  // a line a setting
  return text;
}

/// The program that drives: the one given, with the current folder as its own, else the one kept.
/// Throws InputError.
std::optional<operate::Program> take_program(const RunOptions& o,
                                             std::vector<cases::Override>& kept) {
  const bool was_driven =
      std::any_of(kept.begin(), kept.end(), [](const auto& one) { return one.key == kOperator; });
  const auto given = [&](const std::string& value) {
    return o.program ? std::optional(value) : std::nullopt;
  };
  operate::Program program;
  program.command = take(kOperator, o.program, kept);
  program.folder = take(kOperatorFolder, given(fs::current_path().string()), kept);
  program.sees_truth =
      take(kOperatorTruth, o.truth ? std::optional<std::string>("on") : given(""), kept) == "on";
  if (o.resume && o.program && !was_driven)
    throw InputError({{{},
                       0,
                       "--operator",
                       "the run so far followed its motion; a program can drive from the start of "
                       "a run only"}});
  if (program.command.empty()) {
    if (o.program) throw InputError({{{}, 0, "--operator", "names no program"}});
    if (o.truth) throw InputError({{{}, 0, "--operator-truth", "goes with --operator"}});
    return std::nullopt;
  }
  operate::words_of(program);
  return program;
}

void keep_program(const std::optional<operate::Program>& program,
                  std::vector<cases::Override>& settings) {
  if (!program) return;
  settings.push_back({kOperator, program->command});
  settings.push_back({kOperatorFolder, program->folder.string()});
  if (program->sees_truth) settings.push_back({kOperatorTruth, "on"});
}

/// Where the ranks will be; over several hosts, reports what that means for the run's messages.
/// Starts and writes nothing that stays.
launch::MpiPlaces place(int ranks, const std::string& mpirun, Reporter& reporter) {
  const launch::PlacedRanks placed =
      launch::place_ranks(ranks, launch::mpirun_options(mpirun), installed_program("dipper-dem"));
  if (!placed.places.several_hosts) return placed.places;
  check_host_network();
  reporter.line(fmt::format(
      "network: the host's, which MPI needs, as ranks are on {}. The run's own messages stay on "
      "this host: they are sealed, so nobody can forge them, but all its users can read them",
      placed.hosts));
  return placed.places;
}

int run_case(const RunOptions& o, Reporter& reporter) {
  if (o.resume && !o.no_rock.empty())
    throw InputError({{{}, 0, "--resume", "a run without rock takes seconds; start it again"}});
  launch::catch_interrupts();  // before the first output, whose reading end may be closed
  const fs::path out = run_folder(o);
  // A resumed run keeps the options it was started with, except those given now.
  std::vector<cases::Override> set;
  if (o.resume) {
    if (analysis::report::is_dry_run(out))
      throw InputError({{out, 0, "--resume",
                         "holds a run without rock, which takes seconds; start it again in "
                         "another folder"}});
    set = run::read_settings(out);
  }
  const std::string mpirun = take(kMpirun, o.mpirun, set);
  const std::optional<operate::Program> program = take_program(o, set);
  for (const cases::Override& one : overrides_of(o.set, "coupling.scheme=serial"))
    set.push_back(one);
  if (o.ranks > 0) set.push_back({"dem.ranks", std::to_string(o.ranks)});
  if (o.seed) set.push_back({"seed", std::to_string(*o.seed)});
  const std::optional<cases::Case> c = check::checked_case(o.folder, set, reporter);
  if (!c) return 2;
  if (o.no_rock.empty()) check::report_full_disk(*c, out, reporter);
  if (const int cores = static_cast<int>(std::thread::hardware_concurrency());
      o.no_rock.empty() && mpirun.empty() && cores > 0 && c->dem.ranks > cores)
    reporter.line(
        fmt::format("warning: dem.ranks: {} ranks share {} cores and wait for each other; "
                    "--ranks {} is faster",
                    c->dem.ranks, cores, cores));
  data_folder();  // throws where Dipper's own files are missing, before anything is written
  for (const auto& [folder, remedy] :
       {std::pair{out, "choose another --out"},
        std::pair{cache_folder(), "set XDG_CACHE_HOME to another folder"}}) {
    if (deck::liggghts_takes(folder)) continue;
    reporter.error(
        fmt::format("{}: {}; {}", fs::absolute(folder).string(), deck::kLiggghtsRefuses, remedy));
    return 2;
  }
  if (o.no_rock.empty()) make_writable(cache_folder(), kOtherCache);
  try {
    if (!o.no_rock.empty()) dry::require_drives(*c);
    if (program) run::require_operable(*c);
    const launch::MpiPlaces places =
        o.no_rock.empty() ? place(c->dem.ranks, mpirun, reporter) : launch::MpiPlaces{};
    const result::RunFolder folder =
        o.resume ? result::RunFolder::resume(out) : result::RunFolder::create(out);
    if (o.resume) require_undamaged(folder.root());
    const auto changed = o.resume
                             ? run::changed_since(folder.root(), *c, resumed_from_s(folder, *c))
                             : std::vector<std::string>{};
    for (const auto& line : changed)
      reporter.error(fmt::format("differs from {}: {}", out.string(), line));
    if (!changed.empty()) return 2;
    if (!mpirun.empty()) set.push_back({kMpirun, mpirun});
    keep_program(program, set);
    run::write_settings(folder.root(), set);
    if (!places.several_hosts && enter_own_network(reporter) && o.no_rock.empty())
      reporter.line("network: the run's own, as all ranks are on this host");
    if (!o.no_rock.empty()) {
      const auto rock = o.no_rock == "none" ? dry::RockModel::none : dry::RockModel::estimate;
      const run::RunStatus status = dry::dry_run(*c, rock, folder, program, reporter);
      if (status == run::RunStatus::complete) reporter.line(folder.summary().string());
      return static_cast<int>(status);
    }
    return static_cast<int>(run::paired_run(*c, folder, o.resume, places, program, reporter));
  } catch (const InputError& e) {
    reporter.error(e.what());
    return 2;
  } catch (const launch::Interrupted&) {
    reporter.error("interrupted before the run began");
    return 4;
  }
}

}  // namespace

Command add_run_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<RunOptions>();
  auto* sub =
      app.add_subcommand("run", "run a case: LIGGGHTS computes the rock, Simbody the machine");
  sub->footer(
      "Settles the pile, or takes it from the cache; digs; writes record, dumps and summary into "
      "the run's folder. Ctrl-C stops with a checkpoint. Example:\n  dipper run cases/quick --set "
      "machine.rake_angle_deg=63.8 --out runs/steep");
  sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
  sub->add_option("--set", o->set, "KEY=VALUE: overrides the case");
  sub->add_option("--out", o->out, "the run's folder (default: runs/NAME)");
  sub->add_option("--ranks", o->ranks, "MPI ranks of the rock side")
      ->check(whole_number_in({1, 4096}));
  sub->add_option("--mpirun", o->mpirun,
                  "options of mpirun, such as its hosts: --mpirun '--hostfile hosts'");
  sub->add_option("--seed", o->seed, "seed of the pile")->check(whole_number_in(kSeeds));
  sub->add_flag("--resume", o->resume, "continue the run in --out from its last checkpoint");
  sub->add_option("--operator", o->program,
                  "PROGRAM that drives the machine in place of the motion, by lines of JSON: "
                  "--operator 'python3 mine.py'");
  sub->add_flag("--operator-truth", o->truth,
                "give the program the simulation's true state too, which no instrument measures");
  sub->add_flag(
         "--no-rock{none}", o->no_rock,
         "the machine alone, in seconds; --no-rock=estimate: against an estimate of the rock")
      ->check(CLI::IsMember({"none", "estimate"}));
  return {sub, [o, &reporter] { return run_case(*o, reporter); }};
}

}  // namespace dipper::cli
