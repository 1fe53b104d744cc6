// A run in progress.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/core/coupling.hpp"
#include "coupler/operate/operated_machine.hpp"
#include "coupler/result/run_folder.hpp"
#include "coupler/result/summary.hpp"
#include "coupler/run/checkpointer.hpp"
#include "coupler/run/face_survey.hpp"
#include "coupler/run/pass_desk.hpp"
#include "coupler/run/preparation.hpp"
#include "coupler/run/progress.hpp"
#include "coupler/run/run_record.hpp"
#include "coupler/run/stepper.hpp"
#include "coupler/run/timed_rock.hpp"
#include "coupler/sides/sides.hpp"

namespace dipper::run {

/// What a run uses from its start or checkpoint on: both sides, the coupling between them, the
/// record, and the stepper.
class Session {
 public:
  /// Prepares the run and starts both sides and, if there is one, the program that drives the
  /// machine. `c` and `folder` must outlive this. Throws transport::PeerError, launch::Interrupted,
  /// std::runtime_error.
  Session(const cases::Case& c, const result::RunFolder& folder,
          const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
          const std::optional<operate::Program>& program, Reporter& reporter);

  /// Steps until the end or an interrupt, then saves a checkpoint. Returns whether the end is
  /// reached. Throws as the constructor does.
  bool run();

  /// Closes the record and ends both sides, with "stop" if the run ended without a failure.
  result::RunFacts close(bool orderly);

  const core::CouplingState& state() const { return coupling_.state(); }

 private:
  Session(const cases::Case& c, const result::RunFolder& folder,
          const std::optional<Checkpoint>& from, const std::optional<operate::Program>& program,
          Reporter& reporter, const sides::SidesSetup& setup);
  core::Machine& machine();
  result::RunCost cost() const;
  void report_removed_rocks(const core::Window& first);

  const cases::Case& case_;
  const result::RunFolder& folder_;
  Reporter& reporter_;
  bool resumed_;
  result::RunCost cost_before_;
  std::string operator_command_;
  sides::Sides sides_;
  TimedRock rock_;
  std::unique_ptr<operate::OperatedMachine> operated_;  ///< empty unless a program drives
  core::Coupling coupling_;
  RunRecord record_;
  RunEnd end_;
  std::optional<PassDesk> desk_;
  std::optional<FaceSurvey> survey_;
  Stepper stepper_;
  Progress progress_;
  Checkpointer checkpointer_;
  std::string state_hash_;
};

}  // namespace dipper::run
