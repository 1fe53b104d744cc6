// dipper: the command. Exit status: 0 done; 2 bad usage or input; 3 a run failed; 4 interrupted.
#include <CLI/CLI.hpp>
#include <vector>

#include "common/input_error.hpp"
#include "common/version.hpp"
#include "coupler/cli/calibrate_command.hpp"
#include "coupler/cli/check_command.hpp"
#include "coupler/cli/console.hpp"
#include "coupler/cli/effects_command.hpp"
#include "coupler/cli/environment.hpp"
#include "coupler/cli/face_command.hpp"
#include "coupler/cli/gap_command.hpp"
#include "coupler/cli/motion_command.hpp"
#include "coupler/cli/observe_command.hpp"
#include "coupler/cli/page_command.hpp"
#include "coupler/cli/phases_command.hpp"
#include "coupler/cli/replay_command.hpp"
#include "coupler/cli/report_command.hpp"
#include "coupler/cli/run_command.hpp"

namespace dipper::cli {
namespace {

int command_line(int argc, char** argv, Reporter& reporter) {
  CLI::App app{"Dipper: a mining rope shovel and the rock it digs, co-simulated.", "dipper"};
  app.set_version_flag("--version", version());
  app.require_subcommand(1);
  std::vector<Command> commands = {
      add_check_command(app, reporter),   add_run_command(app, reporter),
      add_replay_command(app, reporter),  add_observe_command(app),
      add_report_command(app, reporter),  add_phases_command(app, reporter),
      add_effects_command(app, reporter), add_calibrate_command(app, reporter),
      add_face_command(app, reporter),    add_motion_command(app, reporter),
      add_page_command(app, reporter)};
  auto* gap = app.add_subcommand("gap", "find and name the effect a case misses");
  gap->prefix_command()->set_help_flag();  // its words are read by the program it becomes
  commands.push_back({gap, [gap] { return gap_command(gap->remaining()); }});
  try {
    app.parse(argc, argv);
    for (const Command& command : commands)
      if (*command.subcommand) return command.run();
    return 2;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
}

}  // namespace
}  // namespace dipper::cli

int main(int argc, char** argv) {
  dipper::cli::Console console;
  dipper::cli::read_environment();
  try {
    return dipper::cli::command_line(argc, argv, console);
  } catch (const dipper::InputError& e) {
    console.error(e.what());
    return 2;
  } catch (const std::exception& e) {
    console.error(e.what());
    return 3;
  }
}
