// dipper: the command. Exit status: 0 done; 2 bad usage or input; 3 a run failed; 4 interrupted.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <utility>

#include "common/cache_folder.hpp"
#include "common/version.hpp"
#include "coupler/check/check.hpp"
#include "coupler/check/check_command.hpp"
#include "coupler/cli/calibrate_command.hpp"
#include "coupler/cli/effects_command.hpp"
#include "coupler/cli/gap_command.hpp"
#include "coupler/cli/page_command.hpp"
#include "coupler/cli/phases_command.hpp"
#include "coupler/cli/report_command.hpp"
#include "coupler/deck/liggghts_path.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/network.hpp"
#include "coupler/run/machine_replay.hpp"
#include "coupler/run/observed.hpp"
#include "coupler/run/paired_run.hpp"
#include "coupler/run/replay.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

/// What the words of the command line say.
struct Words {
  std::string folder;
  std::string out;
  std::string side = "dem";
  std::string case_folder;
  std::vector<std::string> set;
  int ranks = 0;
  std::optional<long> seed;
  bool resume = false;
  bool json = false;
};

std::vector<cases::Override> overrides(const Words& words) {
  std::vector<cases::Override> all;
  for (const auto& s : words.set) {
    const auto equals = s.find('=');
    if (equals == std::string::npos) {
      throw CLI::ValidationError("--set " + s,
                                 "write key=value, as in --set coupling.scheme=serial");
    }
    all.push_back({s.substr(0, equals), s.substr(equals + 1)});
  }
  if (words.ranks > 0) all.push_back({"dem.ranks", std::to_string(words.ranks)});
  if (words.seed) all.push_back({"seed", std::to_string(*words.seed)});
  return all;
}

/// The folder asked for, or runs/NAME, runs/NAME-2, ...: a result is never written over.
fs::path run_folder(const Words& words, const std::string& name) {
  if (!words.out.empty()) return words.out;
  fs::path folder = fs::path("runs") / name;
  for (int k = 2; !words.resume && fs::exists(folder); ++k) {
    folder = fs::path("runs") / fmt::format("{}-{}", name, k);
  }
  return folder;
}

/// Says so aloud where the run cannot be by itself.
void enter_network() {
  if (launch::enter_private_network()) return;
  fmt::print(stderr,
             "dipper: the kernel refuses this run a network of its own; it shares the host's. Its "
             "messages are sealed, so nobody can speak in them, but all users can read them\n");
}

int run_command(const Words& words) {
  if (check::check_command(words.folder, overrides(words), std::cout) != 0) return 2;
  std::vector<cases::Finding> findings;
  const cases::Case c = cases::load_case(words.folder, overrides(words), findings);
  run::RunOptions options;
  options.out = run_folder(words, c.name);
  options.resume = words.resume;
  for (const auto& [folder, remedy] :
       {std::pair{options.out, "choose another --out"},
        std::pair{cache_folder(), "set XDG_CACHE_HOME to another folder"}}) {
    if (deck::liggghts_takes(folder)) continue;
    fmt::print(stderr, "dipper: {}: {}; {}\n", fs::absolute(folder).string(),
               deck::kLiggghtsRefuses, remedy);
    return 2;
  }
  const bool there = fs::exists(options.out / "record.h5");
  if (there && !words.resume) {
    fmt::print(stderr, "dipper: {} holds a run already; choose another --out, or --resume it\n",
               options.out.string());
    return 2;
  }
  if (words.resume && !there) {
    fmt::print(stderr,
               "dipper: {} holds no run to resume; leave out --resume, or name the run's "
               "folder with --out\n",
               options.out.string());
    return 2;
  }
  if (words.resume) {
    const auto changed = run::changed_since(options.out, c);
    for (const auto& line : changed)
      fmt::print(stderr, "dipper: not as in {}: {}\n", options.out.string(), line);
    if (!changed.empty()) return 2;
  }
  launch::catch_interrupts();
  enter_network();
  return static_cast<int>(run::paired_run(c, options));
}

int changed_machine_command(const Words& words) {
  if (words.side != "mbs" || words.out.empty()) {
    throw CLI::ValidationError("--set", "replays another machine: it needs --side mbs and --out");
  }
  std::vector<cases::Finding> findings;
  const cases::Case changed =
      run::case_of_run(words.folder, words.case_folder, overrides(words), findings);
  if (findings.empty()) findings = check::check_case(changed);
  for (const cases::Finding& f : findings) fmt::print(stderr, "{}\n", cases::to_string(f));
  if (!findings.empty()) return 2;
  enter_network();
  run::observe_changed_machine(words.folder, changed, words.out);
  return 0;
}

int replay_command(const Words& words) {
  if (!words.set.empty()) return changed_machine_command(words);
  if (!words.case_folder.empty()) throw CLI::ValidationError("--case", "goes with --set");
  enter_network();
  const run::ReplayResult r = run::replay(words.folder, words.side);
  fmt::print(
      "{}: {} requests of {} leg{} asked again in {:.1f} s; the paired run took {:.1f} s over them "
      "({:.3f} times as long)\n",
      words.side, r.requests, r.legs, r.legs == 1 ? "" : "s", r.wall_s, r.recorded_wall_s,
      r.recorded_wall_s / r.wall_s);
  if (r.different == 0) {
    fmt::print("every answer is the recorded one to the bit\n");
  } else {
    fmt::print("{} answers differ: force by up to {:.3g} N, position by up to {:.3g} m\n",
               r.different, r.force_N, r.position_m);
  }
  return r.different == 0 ? 0 : static_cast<int>(run::Outcome::failed);
}

int observe_command(const Words& words) {
  cases::ObservationCase observation = run::read_observation(fs::path(words.folder) / "case.txt");
  try {
    for (const cases::Override& set : overrides(words)) run::set_observation(observation, set);
  } catch (const std::invalid_argument& e) {
    throw CLI::ValidationError("--set", e.what());
  }
  run::write_observed(fs::path(words.folder) / "record.h5", observation, words.out);
  return 0;
}

int command_line(int argc, char** argv) {
  CLI::App app{"Dipper: a mining rope shovel and the rock it digs, co-simulated.", "dipper"};
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  Words words;
  const auto add = [&](const char* name, const char* what) {
    auto* sub = app.add_subcommand(name, what);
    sub->add_option("CASE", words.folder, "a folder with a case.yaml")->required();
    sub->add_option("--set", words.set, "KEY=VALUE instead of what the case says");
    return sub;
  };
  auto* check = add("check", "check a case: every error at once");
  check->add_flag("--json", words.json, "findings, hash, size and values, for programs");
  auto* run = add("run", "run a case: LIGGGHTS digs, Simbody drives");
  run->add_option("--out", words.out, "the run's folder (default: runs/NAME)");
  run->add_option("--ranks", words.ranks, "MPI ranks of the rock side")->check(CLI::PositiveNumber);
  run->add_option("--seed", words.seed, "seed of the pile");
  run->add_flag("--resume", words.resume, "continue from the last checkpoint");
  auto* again = app.add_subcommand("replay", "run one side against the other's recording");
  again->add_option("DIR", words.folder, "a run's folder")
      ->required()
      ->check(CLI::ExistingDirectory);
  again->add_option("--set", words.set,
                    "KEY=VALUE of another machine, which is observed into --out (with --side mbs)");
  again->add_option("--out", words.out, "the folder to observe another machine into");
  again
      ->add_option("--case", words.case_folder,
                   "the run's case, where it is no longer at its place")
      ->check(CLI::ExistingDirectory);
  again->add_option("--side", words.side, "the side to run: dem or mbs")
      ->check(CLI::IsMember({"dem", "mbs"}))
      ->capture_default_str();
  auto* observe = app.add_subcommand("observe", "a run as the mine's instruments would show it");
  observe->add_option("DIR", words.folder, "a run's folder")
      ->required()
      ->check(CLI::ExistingDirectory);
  observe->add_option("--out", words.out, "the folder to write")->required();
  observe->add_option("--set", words.set,
                      "observation.KEY=VALUE instead of what the run's case says");
  auto* phases = app.add_subcommand("phases", "passes and phases as JSON");
  phases->add_option("DIR", words.folder, "a run's folder, or - for readings on standard input")
      ->required();
  auto* effects = app.add_subcommand("effects", "the effects a case can take, as JSON");
  effects->add_option("CASE", words.folder, "a folder with a case.yaml")->required();
  ReportWords report_words;
  auto* report = app.add_subcommand("report", "metrics, tables and the page of a run, or of dumps");
  report->add_option("DIR", report_words.folder, "a run's folder, or one with dumps of LIGGGHTS")
      ->required();
  report->add_option("--out", report_words.out, "the report's folder (default: DIR/report)");
  report->add_option("--timestep", report_words.timestep_s, "of the DEM [s], when no file tells it")
      ->check(CLI::PositiveNumber);
  report->add_option("--mesh", report_words.mesh, "the dipper's STL, for dumps without a record");
  report->add_option("--poses", report_words.poses, "its poses: time_s,x_m,y_m,z_m,qw,qx,qy,qz");
  const auto calibrate = add_calibrate_command(app);
  auto* gap = app.add_subcommand("gap", "find and name the effect a case misses");
  gap->prefix_command()->set_help_flag();  // its words are read by the program it becomes
  std::string page_file;
  auto* page = app.add_subcommand("page", "the page of the JSON on standard input");
  page->add_option("FILE", page_file, "the HTML file to write")->required();
  page->group("");  // not in --help: dipper gap calls it
  try {
    app.parse(argc, argv);
    if (app.got_subcommand("calibrate")) return calibrate();
    if (*gap) return gap_command(gap->remaining());
    if (*check)
      return (words.json ? check::check_json_command : check::check_command)(
          words.folder, overrides(words), std::cout);
    if (*again) return replay_command(words);
    if (*report) return report_command(report_words);
    if (*page) return page_command(page_file);
    if (*phases) return phases_command(words.folder, std::cin, std::cout);
    if (*effects) return effects_command(words.folder, std::cout);
    if (*observe) return observe_command(words);
    return run_command(words);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
}

}  // namespace
}  // namespace dipper::cli

int main(int argc, char** argv) {
  try {
    return dipper::cli::command_line(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "dipper: {}\n", e.what());
    return 3;
  }
}
