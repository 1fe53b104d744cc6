#include "coupler/cli/completion_command.hpp"

#include <fmt/format.h>

#include <memory>

#include "common/version.hpp"

namespace dipper::cli {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// Words of roff: a hyphen stays one, and no line begins with what roff takes for itself.
std::string roff(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || c == '-') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return !out.empty() && (out[0] == '.' || out[0] == '\'') ? "\\&" + out : out;
}

/// "--out TEXT" or "CASE".
std::string words_of(const CLI::Option& option) {
  if (option.get_lnames().empty()) return option.get_name();
  const std::string name = "--" + option.get_lnames().front();
  std::string type = option.get_type_name();
  type = type.substr(0, type.find(':'));  // without the names of what checks it
  return type.empty() ? name : name + " " + type;
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += (names.empty() ? "" : " ") + command->get_name();
    std::string options;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) options += " --" + name;
    if (!options.empty())
      cases += fmt::format("    {}) options=\"{}\" ;;\n", command->get_name(), options.substr(1));
  }
  return fmt::format(
      "# bash completion of dipper: eval \"$(dipper completion)\"\n"
      "_dipper() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} options=\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n"
      "{}"
      "  esac\n"
      "  case $word in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o default -F _dipper dipper\n",
      names, cases);
}

std::string manual_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".TH DIPPER 1 \"\" \"dipper {}\" \"Dipper\"\n.SH NAME\ndipper \\- {}\n.SH SYNOPSIS\n.B "
      "dipper\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n",
      roff(version()), roff(app.get_description()));
  for (const CLI::App* command : commands_of(app)) {
    out += fmt::format(".SS dipper {}\n{}\n", roff(command->get_name()),
                       roff(command->get_description()));
    if (const std::string more = command->get_footer(); !more.empty())
      out += fmt::format(".PP\n{}\n", roff(more));
    for (const CLI::Option* option : command->get_options())
      out +=
          fmt::format(".TP\n.B {}\n{}\n", roff(words_of(*option)), roff(option->get_description()));
  }
  out +=
      ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 2\nbad usage or input: nothing started\n.TP\n.B "
      "3\n"
      "a run failed: the message names the side, the time and the last checkpoint\n.TP\n.B 4\n"
      "interrupted, and can be resumed\n";
  return out;
}

Command add_completion_command(CLI::App& app, Reporter& reporter) {
  const auto man = std::make_shared<bool>(false);
  auto* sub = app.add_subcommand(
      "completion", "the script by which bash completes dipper's words, or the manual page");
  sub->footer(
      "Both are made from the options themselves. Example, in ~/.bashrc:\n  eval \"$(dipper "
      "completion)\"");
  sub->add_flag("--man", *man, "the manual page instead: dipper completion --man | man -l -");
  return {sub, [man, &app, &reporter] {
            reporter.line(*man ? manual_page(app) : bash_completion(app));
            return 0;
          }};
}

}  // namespace dipper::cli
