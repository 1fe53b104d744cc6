#include "coupler/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/begins_with.hpp"
#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "common/version.hpp"
#include "coupler/cli/calibrate_command.hpp"
#include "coupler/cli/check_command.hpp"
#include "coupler/cli/clean_command.hpp"
#include "coupler/cli/completion_command.hpp"
#include "coupler/cli/console.hpp"
#include "coupler/cli/effects_command.hpp"
#include "coupler/cli/environment.hpp"
#include "coupler/cli/face_command.hpp"
#include "coupler/cli/motion_command.hpp"
#include "coupler/cli/observe_command.hpp"
#include "coupler/cli/page_command.hpp"
#include "coupler/cli/phases_command.hpp"
#include "coupler/cli/preview_command.hpp"
#include "coupler/cli/python_command.hpp"
#include "coupler/cli/replay_command.hpp"
#include "coupler/cli/report_command.hpp"
#include "coupler/cli/run_command.hpp"

namespace dipper::cli {
namespace {

/// `dipper help WORDS` is `dipper WORDS --help`: command_line() rewrites it before it is parsed, so
/// that this is only a line in the list of commands.
Command add_help_command(CLI::App& app) {
  return {app.add_subcommand("help", "this list, or the options of a command: dipper help run"),
          [] { return 0; }};
}

/// The known word nearest to the first unknown one; empty: none is near.
std::string guess(const CLI::App& app, const std::vector<std::string>& words) {
  const CLI::App* command = nullptr;
  std::vector<std::string> known;
  for (const CLI::App* sub : listed_commands(app)) {
    known.push_back(sub->get_name());
    if (!words.empty() && sub->get_name() == words.front()) command = sub;
  }
  if (words.empty()) return "";
  if (command == nullptr) return nearest_word(words.front(), known);
  known.clear();
  for (const CLI::Option* option : command->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (std::string word : words) {
    word = word.substr(0, word.find('='));
    if (word.rfind("--", 0) != 0 || std::count(known.begin(), known.end(), word) != 0) continue;
    return nearest_word(word, known);
  }
  return "";
}

/// In the order of work: help lists them so.
std::vector<Command> add_commands(CLI::App& app, const std::vector<std::string>& words,
                                  Reporter& reporter) {
  return {add_import_command(app, words),
          add_survey_command(app, words),
          add_motion_command(app, reporter),
          add_check_command(app, reporter),
          add_preview_command(app, reporter),
          add_calibrate_command(app, reporter),
          add_run_command(app, reporter),
          add_report_command(app, reporter),
          add_face_command(app, reporter),
          add_study_command(app, words),
          add_gap_command(app, words),
          add_observe_command(app),
          add_replay_command(app, reporter),
          add_effects_command(app, reporter),
          add_phases_command(app, reporter),
          add_page_command(app, reporter),
          add_clean_command(app, reporter),
          add_completion_command(app, reporter),
          add_help_command(app)};
}

}  // namespace

int command_line(std::vector<std::string> words, Reporter& reporter) {
  CLI::App app{"Dipper: a mining rope shovel and the rock it digs, co-simulated.", "dipper"};
  app.set_version_flag("--version", version());
  app.footer("Options of a command, with an example:\n  dipper help run");
  app.require_subcommand(1);
  const bool help = !words.empty() && words.front() == "help";
  if (help) {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  const std::vector<Command> commands = add_commands(app, words, reporter);
  const auto asked = [&](const CLI::App* sub) { return sub->get_name() == words.front(); };
  if (!words.empty() && !begins_with(words.front(), "-") && app.get_subcommands(asked).empty()) {
    const std::string meant = guess(app, words);
    reporter.error(words.front() + " is not a command; " +
                   (meant.empty() ? "dipper help lists them" : "did you mean " + meant + "?"));
    return 2;
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11's order
    for (const Command& command : commands)
      if (*command.subcommand) return command.run();
    return 2;
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) == 0) return 0;
    if (const std::string meant = guess(app, words); !meant.empty())
      reporter.error("did you mean " + meant + "?");
    return 2;
  }
}

}  // namespace dipper::cli
