#include "coupler/operate/conversation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "common/input_error.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/shell_words.hpp"
#include "coupler/operate/answer.hpp"
#include "coupler/transport/link.hpp"

namespace dipper::operate {
namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
namespace {

constexpr int kVersion = 1;  // of the lines
constexpr const char* kGreeting = "dipper_operator";
constexpr std::chrono::seconds kToEnd{2};

void watch() {
  if (launch::interrupts() > 1) throw launch::Interrupted();
}

bool can_run(const fs::path& program) {
  return fs::is_regular_file(program) && access(program.c_str(), X_OK) == 0;
}

/// As execvp looks for it, from the folder in which it will be started.
bool is_there(const std::string& name, const fs::path& folder) {
  if (name.find('/') != std::string::npos) return can_run(folder / name);
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/bin:/usr/bin" : path);
  for (std::string one; std::getline(folders, one, ':');)
    if (can_run(folder / one / name)) return true;
  return false;
}

}  // namespace

std::vector<std::string> words_of(const Program& program) {
  const std::vector<std::string> words = launch::shell_words(program.command, "--operator");
  const auto refuse = [](const std::string& why) {
    throw InputError({{{}, 0, "--operator", why}});
  };
  if (words.empty()) refuse("names no program");
  if (!is_there(words.front(), program.folder))
    refuse(fmt::format("{}: no such program in {} or on the PATH", words.front(),
                       program.folder.string()));
  return words;
}

Conversation::Conversation(const Program& program, const fs::path& log,
                           std::chrono::milliseconds patience)
    : command_(program.command),
      dialogue_(words_of(program), log, program.folder, patience, watch) {}

void Conversation::fail(const std::string& what) const {
  throw transport::PeerError("operator", fmt::format("`{}`: {}", command_, what));
}

std::string Conversation::ask(const std::string& line) {
  try {
    dialogue_.say(line);
    return dialogue_.hear();
  } catch (const launch::Interrupted&) {
    throw;
  } catch (const std::exception& e) {
    fail(e.what());
  }
}

void Conversation::greet(json hello, const std::string& state) {
  json line = {{kGreeting, kVersion}};
  line.update(hello);
  line["resumed"] = !state.empty();
  const std::string answer = ask(line.dump() + (state.empty() ? "" : '\n' + state));
  try {
    const nlohmann::json said = parsed(answer);
    if (!said.is_object() || said.size() != 1 || said.value(kGreeting, 0) != kVersion)
      throw std::runtime_error(fmt::format("its first line must be {{\"{}\": {}}}, and is '{}'",
                                           kGreeting, kVersion, answer));
  } catch (const std::exception& e) {
    fail(e.what());
  }
}

std::string Conversation::look(const json& shown) { return ask(shown.dump()); }

std::string Conversation::save() {
  const std::string answer = ask(json{{"save", true}}.dump());
  try {
    const nlohmann::json said = parsed(answer);
    if (!said.is_object() || said.size() != 1 || !said.contains("state"))
      throw std::runtime_error("asked to save, it must answer {\"state\": ...}, not '" + answer +
                               "'");
  } catch (const std::exception& e) {
    fail(e.what());
  }
  return answer;
}

void Conversation::end() {
  try {
    dialogue_.say(json{{"end", true}}.dump());
  } catch (const std::runtime_error&) {  // it has gone, as it may
  }
  dialogue_.dismiss(kToEnd);
}

}  // namespace dipper::operate
