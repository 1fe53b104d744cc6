#include "coupler/run/paired_run.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "common/input_error.hpp"
#include "common/record/record.hpp"
#include "common/shell_word.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/result/observed.hpp"
#include "coupler/result/summary.hpp"
#include "coupler/run/preparation.hpp"
#include "coupler/run/session.hpp"

namespace dipper::run {
namespace {

const char* word(RunStatus status) {
  switch (status) {
    case RunStatus::complete:
      return "complete";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::failed:
      break;
  }
  return "failed";
}

double time_s(const core::CouplingState& at, const cases::Case& c) {
  return static_cast<double>(at.dem_step) * c.dem.timestep_s;
}

/// How to resume the run, for the message that explains why it stopped.
std::string how_to_resume(const cases::Case& c, const result::RunFolder& folder) {
  std::optional<Checkpoint> last;
  try {
    last = last_checkpoint(folder.checkpoints());
  } catch (const InputError& e) {
    return e.what();
  }
  if (!last) return "no checkpoint yet";
  return fmt::format("last checkpoint: {} (t = {:.3f} s); `dipper run {} --out {} --resume`",
                     last->folder.string(), time_s(last->coupling, c), shell_word(c.folder),
                     shell_word(folder.root()));
}

/// Prepares a run without a checkpoint to begin again. Throws InputError where that would lose more
/// than the way to a first checkpoint.
void begin_again(const cases::Case& c, const result::RunFolder& folder, Reporter& reporter) {
  double recorded_s = 0;
  try {
    const std::vector<double> t = record::read_channel(folder.record(), "time_s");
    if (!t.empty()) recorded_s = t.back();
  } catch (const InputError&) {  // killed before it was written
  }
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  const double every_s = c.output.checkpoint_every_s;
  if (recorded_s > (every_s > 0 ? every_s + window_s : 0))
    throw InputError(
        {{folder.checkpoints(), 0, "",
          fmt::format("holds no checkpoint of this run, which came to t = {:.3f} s and "
                      "would begin again; run the case into another --out",
                      recorded_s)}});
  reporter.line("no checkpoint yet: the run begins again");
  for (const auto& left : {folder.dumps(), folder.faces(), folder.decisions()})
    std::filesystem::remove_all(left);
  std::filesystem::create_directory(folder.dumps());
}

/// Closes the session, then writes summary and observed signals from the closed record.
void conclude(const cases::Case& c, const result::RunFolder& folder,
              std::unique_ptr<Session> session, RunStatus status, const std::string& failure,
              Reporter& reporter) {
  const bool in_order = status != RunStatus::failed && launch::interrupts() < 2;
  result::RunFacts facts = session->close(in_order);
  session.reset();
  facts.status = word(status);
  facts.failure = failure;
  // The summary comes last: "complete" means that all other files are written.
  if (c.machine.kind == cases::MachineKind::shovel)
    result::write_observed(folder.record(), c.observation, folder.observed());
  result::write_summary(c, folder, facts, reporter);
  folder.seal();
}

}  // namespace

RunStatus paired_run(const cases::Case& c, const result::RunFolder& folder, bool resume,
                     const launch::MpiPlaces& places,
                     const std::optional<operate::Program>& program, Reporter& reporter) {
  const auto from = resume ? last_checkpoint(folder.checkpoints()) : std::nullopt;
  if (resume && result::summary_status(folder.summary()) == "complete") {
    if (!from)
      throw InputError({{folder.checkpoints(), 0, "",
                         "holds no checkpoint of this complete run to continue from; run the case "
                         "again into another --out"}});
    if (is_done(run_end(c, program.has_value()), *from, folder.record())) {
      reporter.line("complete already: " + folder.summary().string());
      return RunStatus::complete;
    }
  }
  if (resume && !from) begin_again(c, folder, reporter);
  RunStatus status = RunStatus::failed;
  std::string failure;
  std::unique_ptr<Session> session;
  core::CouplingState at = from ? from->coupling : core::CouplingState{};
  const auto where = [&] {
    if (session) at = session->state();
    return fmt::format("at t = {:.4f} s (sync step {})", time_s(at, c), at.step_index);
  };
  try {
    session = std::make_unique<Session>(c, folder, from, places, program, reporter);
    status = session->run() ? RunStatus::complete : RunStatus::interrupted;
  } catch (const launch::Interrupted&) {
    status = RunStatus::interrupted;
  } catch (const transport::PeerError& e) {
    failure = fmt::format("the {} side failed {}: {}", e.side, where(), e.what());
  } catch (const std::exception& e) {
    failure = fmt::format("{}: {}", where(), e.what());
  }
  if (session) {
    at = session->state();
    try {
      conclude(c, folder, std::move(session), status, failure, reporter);
    } catch (const std::exception& e) {
      status = RunStatus::failed;
      failure += (failure.empty() ? "" : "; ") + std::string(e.what());
    }
  }
  switch (status) {
    case RunStatus::complete:
      reporter.line(folder.summary().string());
      break;
    case RunStatus::interrupted:
      reporter.error(
          fmt::format("interrupted at t = {:.3f} s; {}", time_s(at, c), how_to_resume(c, folder)));
      break;
    case RunStatus::failed:
      reporter.error(failure);
      reporter.error(how_to_resume(c, folder));
  }
  return status;
}

}  // namespace dipper::run
