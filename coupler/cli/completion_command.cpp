#include "coupler/cli/completion_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <sstream>

#include "common/begins_with.hpp"
#include "common/version.hpp"

namespace dipper::cli {
namespace {

/// Escapes text for roff: hyphens, and characters that are commands at the start of a line.
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

std::string names_of(const CLI::App& app) {
  std::string names;
  for (const CLI::App* command : listed_commands(app))
    names += (names.empty() ? "" : " ") + command->get_name();
  return names;
}

/// A command's lines in the script, after those of its subcommands: the first that matches is used.
std::string completion_case(const CLI::App& command, const std::string& before) {
  const std::string words = before + command.get_name() + " ";
  std::string lines, options;
  for (const CLI::App* own : listed_commands(command)) lines += completion_case(*own, words);
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames())
      options += (options.empty() ? "--" : " --") + name;
  return lines + fmt::format("    \"{}\"*) options=\"{}\" commands=\"{}\" ;;\n", words, options,
                             names_of(command));
}

/// A footer: its text, and the lines of its example, which are indented, each as it is.
std::string roff_footer(const std::string& footer) {
  std::string out = ".PP\n";
  bool example = false;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const bool indented = begins_with(line, "  ");
    if (indented != example) out += indented ? ".PP\n.nf\n" : ".fi\n.PP\n";
    example = indented;
    out += (indented ? "    " + roff(line.substr(2)) : roff(line)) + "\n";
  }
  return out + (example ? ".fi\n" : "");
}

std::string manual_section(const CLI::App& command, const std::string& before) {
  const std::string words = before + " " + command.get_name();
  std::string out = fmt::format(".SS {}\n{}\n", roff(words), roff(command.get_description()));
  if (const std::string more = command.get_footer(); !more.empty()) out += roff_footer(more);
  for (const CLI::Option* option : command.get_options())
    out +=
        fmt::format(".TP\n.B {}\n{}\n", roff(words_of(*option)), roff(option->get_description()));
  for (const CLI::App* own : listed_commands(command)) out += manual_section(*own, words);
  return out;
}

}  // namespace

std::vector<const CLI::App*> listed_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string bash_completion(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : listed_commands(app)) cases += completion_case(*command, "");
  return fmt::format(
      "# bash completion of dipper: eval \"$(dipper completion)\"\n"
      "_dipper() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} all=\"{0}\" options= commands=\n"
      "  COMPREPLY=()\n"
      "  case \"${{COMP_WORDS[*]:1:COMP_CWORD-1}} \" in\n"
      "    \" \") options=\"--help --version\" commands=$all ;;\n"
      "    \"help \") commands=$all ;;\n"
      "{1}"
      "  esac\n"
      "  case $word in\n"
      "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
      "    *) COMPREPLY=($(compgen -W \"$commands\" -- \"$word\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o default -F _dipper dipper\n",
      names_of(app), cases);
}

std::string manual_page(const CLI::App& app) {
  std::string out = fmt::format(
      ".TH DIPPER 1 \"\" \"dipper {}\" \"Dipper\"\n.SH NAME\ndipper \\- {}\n.SH SYNOPSIS\n.B "
      "dipper\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n",
      roff(version()), roff(app.get_description()));
  for (const CLI::App* command : listed_commands(app)) out += manual_section(*command, "dipper");
  out +=
      ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 2\nbad usage or input: nothing started\n.TP\n.B "
      "3\n"
      "a run failed: the message names the side, the time and the last checkpoint\n.TP\n.B 4\n"
      "interrupted, and can be resumed\n";
  return out;
}

Command add_completion_command(CLI::App& app, Reporter& reporter) {
  const auto man = std::make_shared<bool>(false);
  auto* sub = app.add_subcommand("completion", "bash completion, or the manual page");
  sub->footer(
      "Both list every command and option. Example, in ~/.bashrc:\n  eval \"$(dipper "
      "completion)\"");
  sub->add_flag("--man", *man, "print the manual page: dipper completion --man | man -l -");
  return {sub, [man, &app, &reporter] {
            reporter.line(*man ? manual_page(app) : bash_completion(app));
            return 0;
          }};
}

}  // namespace dipper::cli
