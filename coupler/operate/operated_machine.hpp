// A machine and the program that drives it, as one.
#pragma once

#include <functional>
#include <memory>

#include "coupler/core/server.hpp"
#include "coupler/operate/answer.hpp"
#include "coupler/operate/conversation.hpp"
#include "coupler/operate/instruments.hpp"
#include "coupler/operate/program.hpp"

namespace dipper::operate {

/// The program's first input: the machine's data, before the first look.
struct Operated {
  std::string case_name;
  std::filesystem::path motion;  ///< the case's
  machine::MachineData machine;  ///< as its file says: no instrument shows its condition
  double rake = 0;               ///< rad
  Program program;
  std::chrono::milliseconds patience{60000};  ///< for each answer
  std::filesystem::path log;                  ///< of the program's stderr
};

/// The simulation's truth: the rock's latest channels.
struct RockTruth {
  core::ServerInfo info;
  std::function<const core::RockState&()> state;
};

/// Asks the program where the drives are to go, at the first window of each look, and gives the
/// machine its orders. With each state of the machine the program's is saved, beside it, and
/// loaded. What the program does wrong is a transport::PeerError of the side "operator".
class OperatedMachine final : public core::Machine {
 public:
  /// Starts the program, and greets it if the run is new; else `load` does. `inner` must live as
  /// long as this.
  OperatedMachine(core::Machine& inner, const Operated& setup, bool resumed,
                  const RockTruth& truth);

  core::ServerInfo info() const override { return inner_.info(); }
  core::MachineState state(std::int64_t t_next_ns) override;
  core::MachineState step(const core::MachineStep& step) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;

  /// The program has said that the run may end.
  bool done() const { return done_; }

  /// Lets the program end.
  void end() { conversation_.end(); }

 private:
  void greet(const std::string& state);
  core::Order look();
  nlohmann::ordered_json truth() const;

  core::Machine& inner_;
  Operated setup_;
  RockTruth truth_;
  Conversation conversation_;
  Instruments instruments_;
  AnswerReader answers_;
  core::MachineState now_;
  std::int64_t looked_ = -1;  ///< multiple of kLook_ns of the last look
  bool done_ = false;
};

/// Whether the program had said that the run may end when this state of the machine was saved.
/// Throws std::runtime_error naming the file.
bool had_done(const std::filesystem::path& machine_state);

}  // namespace dipper::operate
