#include "coupler/run/session.hpp"

#include <fmt/format.h>

#include "common/sha256.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/result/dump_index.hpp"
#include "coupler/run/preparation.hpp"

namespace dipper::run {
namespace {

core::Coupling coupled(const cases::Case& c, core::Machine& machine, TimedRock& rock,
                       const std::optional<Checkpoint>& from) {
  core::Coupling coupling(machine, rock, c.coupling.scheme);
  if (from) {
    std::vector<Pose> X_WB;
    for (const core::WallState& wall : from->coupling.walls) X_WB.push_back(wall.X_WB);
    machine.load(from->machine());
    rock.place(X_WB);
    coupling.resume(from->coupling);
  }
  return coupling;
}

double channel(const core::Window& w, const core::ServerInfo& rock, const std::string& name) {
  return w.rock.channels[core::channel_index(rock, name)];
}

}  // namespace

Session::Session(const cases::Case& c, const result::RunFolder& folder,
                 const std::optional<Checkpoint>& from, const launch::MpiPlaces& places,
                 const std::optional<operate::Program>& program, Reporter& reporter)
    : Session(c, folder, from, program, reporter,
              prepare(c, folder, from, places, program.has_value(), reporter)) {}

Session::Session(const cases::Case& c, const result::RunFolder& folder,
                 const std::optional<Checkpoint>& from,
                 const std::optional<operate::Program>& program, Reporter& reporter,
                 const sides::SidesSetup& setup)
    : case_(c),
      folder_(folder),
      reporter_(reporter),
      resumed_(from.has_value()),
      cost_before_(from ? from->cost : result::RunCost{}),
      operator_command_(program ? program->command : ""),
      sides_(setup),
      rock_(sides_.rock()),
      operated_(program ? std::make_unique<operate::OperatedMachine>(
                              sides_.machine(), operated(c, *program, folder, setup.segment),
                              from.has_value(),
                              operate::RockTruth{
                                  sides_.rock().info(),
                                  [this]() -> const core::RockState& { return rock_.last(); }})
                        : nullptr),
      coupling_(coupled(c, machine(), rock_, from)),
      record_(folder.record(), sides_.machine().info(), rock_.info(),
              record_attributes(c, sides_.machine().info(), rock_.info(), program),
              from ? from->record : RecordPosition{}),
      end_(run_end(c, program.has_value())),
      stepper_(coupling_, c.coupling.sync_steps, end_.step),
      progress_(reporter, c, end_, sides_.machine().info(), rock_.info()),
      checkpointer_(folder.checkpoints(), c.output.checkpoint_every_s,
                    {coupling_, machine(), rock_, record_, [this] { return cost(); },
                     [this] { return desk_ ? desk_->state() : nlohmann::json(); }}) {
  end_with_path(stepper_, end_, sides_.machine().info());
  if (operated_) stepper_.end_when([this](const core::MachineState&) { return operated_->done(); });
  stepper_.add(record_);
  stepper_.add(progress_);
  if (c.machine.kind == cases::MachineKind::shovel) {
    survey_.emplace(c, FaceSurvey::Sides{rock_, sides_.machine().info()}, folder.faces(),
                    from ? &coupling_.machine_state() : nullptr);
    stepper_.add(*survey_);
  }
  if (c.machine.operated_by == cases::OperatorKind::plan && !program) {
    desk_.emplace(c,
                  PassDesk::Sides{sides_.machine(), rock_, sides_.machine().info(), rock_.info()},
                  folder.decisions(), from ? from->desk : nlohmann::json(), reporter);
    stepper_.add(*desk_);  // before the checkpointer, which saves its decision
    stepper_.end_when([this](const core::MachineState&) { return desk_->finished(); });
    progress_.follow([this] { return Progress::Passes{desk_->passes(), desk_->expected_end_s()}; });
  }
  stepper_.add(checkpointer_);
}

core::Machine& Session::machine() {
  if (operated_) return *operated_;
  return sides_.machine();
}

bool Session::run() {
  if (!resumed_) {
    const core::Window& first = stepper_.start();
    if (case_.pile.clear_machine) report_removed_rocks(first);
  }
  const bool complete = stepper_.run([] { return launch::interrupts() > 0; });
  if (complete) {  // both from the last checkpoint
    const auto last = last_checkpoint(folder_.checkpoints());
    state_hash_ = sha256(rock_.state_hash() + sha256_file(last->machine()));
  }
  return complete;
}

void Session::report_removed_rocks(const core::Window& first) {
  reporter_.line(
      fmt::format("start: {:.0f} rocks, {:.2f} t, overlapped the machine and were removed",
                  channel(first, rock_.info(), "rocks_removed"),
                  channel(first, rock_.info(), "mass_removed") * 1e-3));
}

result::RunCost Session::cost() const {
  const transport::Link &machine = sides_.machine_link(), &rock = sides_.rock_link();
  return cost_before_ + result::RunCost{sides_.dem_cpu_s(),
                                        sides_.mbs_cpu_s(),
                                        stepper_.wall_s(),
                                        rock_.busy_s(),
                                        machine.resends() + rock.resends(),
                                        machine.foreign() + rock.foreign()};
}

result::RunFacts Session::close(bool orderly) {
  if (orderly && operated_) operated_->end();
  if (orderly) sides_.stop();
  sides_.end();
  result::RunFacts f;
  f.state_hash = state_hash_;
  f.operator_command = operator_command_;
  f.cost = cost();
  f.syncs = coupling_.state().step_index;
  f.dem_steps = coupling_.state().dem_step;
  const RecordPosition& at = record_.position();
  f.interface_work_J = at.rock_work_J;
  f.energy_residual_J = at.machine_work_J - at.rock_work_J;
  record_.flush();
  result::index_dumps(folder_.dumps(), case_.dem.timestep_s);
  return f;
}

}  // namespace dipper::run
