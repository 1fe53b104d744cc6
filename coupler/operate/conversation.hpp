// The lines between a run and the program that drives its machine (docs/operator_program.md).
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/launch/dialogue.hpp"
#include "coupler/operate/program.hpp"

namespace dipper::operate {

/// A running program. All throw transport::PeerError of the side "operator", with the command and
/// what is wrong, and launch::Interrupted at the user's second interrupt.
class Conversation {
 public:
  /// Starts the program. \param log  where its stderr goes. \param patience  for each answer
  Conversation(const Program& program, const std::filesystem::path& log,
               std::chrono::milliseconds patience);

  /// The first line to it, and its own. \param state  the line with which it once answered `save`;
  /// "": a new run
  void greet(nlohmann::ordered_json hello, const std::string& state);

  /// Its answer to a look.
  std::string look(const nlohmann::ordered_json& shown);

  /// The line with its state.
  std::string save();

  /// No more looks come; it may end by itself.
  void end();

  /// Fails as all do.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string ask(const std::string& line);

  std::string command_;
  launch::Dialogue dialogue_;
};

/// The words of a program's command line. Throws InputError that names --operator for quotes that
/// do not match and a program that is not there.
std::vector<std::string> words_of(const Program& program);

}  // namespace dipper::operate
