#include "coupler/run/session.hpp"

#include <fmt/format.h>

#include "common/sha256.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/result/dump_index.hpp"
#include "coupler/run/preparation.hpp"

namespace dipper::run {
namespace {

core::Coupling coupled(const cases::Case& c, sides::Sides& sides, TimedRock& rock,
                       const std::optional<Checkpoint>& from) {
  core::Coupling coupling(sides.machine(), rock, c.coupling.scheme);
  if (from) {
    std::vector<Pose> X_WB;
    for (const core::WallState& wall : from->coupling.walls) X_WB.push_back(wall.X_WB);
    sides.machine().load(from->machine());
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
                 Reporter& reporter)
    : Session(c, folder, from, reporter, prepare(c, folder, from, places, reporter)) {}

Session::Session(const cases::Case& c, const result::RunFolder& folder,
                 const std::optional<Checkpoint>& from, Reporter& reporter,
                 const sides::SidesSetup& setup)
    : case_(c),
      folder_(folder),
      reporter_(reporter),
      resumed_(from.has_value()),
      cost_before_(from ? from->cost : result::RunCost{}),
      sides_(setup),
      rock_(sides_.rock()),
      coupling_(coupled(c, sides_, rock_, from)),
      record_(folder.record(), sides_.machine().info(), rock_.info(),
              record_attributes(c, sides_.machine().info(), rock_.info()),
              from ? from->record : RecordPosition{}),
      end_(run_end(c)),
      stepper_(coupling_, c.coupling.sync_steps, end_.step),
      progress_(reporter, c, end_, sides_.machine().info(), rock_.info()),
      checkpointer_(folder.checkpoints(), c.output.checkpoint_every_s,
                    {coupling_, sides_.machine(), rock_, record_, [this] { return cost(); }}) {
  end_with_path(stepper_, end_, sides_.machine().info());
  stepper_.add(record_);
  stepper_.add(progress_);
  stepper_.add(checkpointer_);
}

bool Session::run() {
  if (!resumed_) {
    const core::Window& first = stepper_.start();
    if (case_.pile.clear_machine) tell_removed_rocks(first);
  }
  const bool complete = stepper_.run([] { return launch::interrupts() > 0; });
  if (complete) {  // rock and machine together, as both stand in the last checkpoint
    const auto last = last_checkpoint(folder_.checkpoints());
    state_hash_ = sha256(rock_.state_hash() + sha256_file(last->machine()));
  }
  return complete;
}

void Session::tell_removed_rocks(const core::Window& first) {
  reporter_.line(
      fmt::format("start: {:.0f} rocks, {:.2f} t, overlapped the machine and were removed",
                  channel(first, rock_.info(), "rocks_removed"),
                  channel(first, rock_.info(), "mass_removed") * 1e-3));
}

result::RunCost Session::cost() const {
  return cost_before_ +
         result::RunCost{sides_.dem_cpu_s(), sides_.mbs_cpu_s(), stepper_.wall_s(), rock_.busy_s()};
}

result::RunFacts Session::close(bool orderly) {
  if (orderly) sides_.stop();
  sides_.end();
  result::RunFacts f;
  f.state_hash = state_hash_;
  f.resends = sides_.machine_link().resends() + sides_.rock_link().resends();
  f.foreign_messages = sides_.machine_link().foreign() + sides_.rock_link().foreign();
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
