#include "coupler/transport/remote.hpp"

#include <cmath>

#include "coupler/transport/codec.hpp"

namespace dipper::transport {
namespace {

template <class Expected>
Expected take(core::Body body, const std::string& side) {
  if (auto* expected = std::get_if<Expected>(&body)) return std::move(*expected);
  throw PeerError(side, "answered with the wrong kind of message");
}

std::string command(Link& link, core::Action action, const std::string& file,
                    const core::SyncTime& now) {
  return take<core::Status>(link.ask(core::Command{action, file}, now.step_index, now.t_ns),
                            link.side())
      .text;
}

}  // namespace

RemoteMachine::RemoteMachine(Link& link) : link_(link) {
  info_ = info_from_json(command(link_, core::Action::hello, "", {}));
  link_.bodies = info_.bodies;
}

core::MachineState RemoteMachine::state() {
  auto m = take<core::TargetMotion>(
      link_.ask(core::Command{core::Action::state, ""}, now_.step_index, now_.t_ns), link_.side());
  return {now_.t_ns, std::move(m.bodies), std::move(m.channels), m.contact};
}

core::MachineState RemoteMachine::step(std::int64_t t_end_ns, const std::vector<Wrench>& F_Bo_W,
                                       bool commit) {
  core::WallWrench request;
  request.commit = commit;
  for (const auto& F : F_Bo_W) request.bodies.push_back({F, F, Pose{}});
  auto m = take<core::TargetMotion>(link_.ask(std::move(request), now_.step_index, t_end_ns),
                                    link_.side());
  return {t_end_ns, std::move(m.bodies), std::move(m.channels), m.contact};
}

void RemoteMachine::save(const std::filesystem::path& file) {
  command(link_, core::Action::save, file, now_);
}
void RemoteMachine::load(const std::filesystem::path& file) {
  command(link_, core::Action::load, file, now_);
}
void RemoteMachine::stop() {
  link_.tell(core::Command{core::Action::stop, ""}, now_.step_index, now_.t_ns);
}

RemoteRock::RemoteRock(Link& link) : link_(link) {
  info_ = info_from_json(command(link_, core::Action::hello, "", {}));
  link_.bodies = info_.bodies;
  dt_ns_ = std::llround(info_.timestep_s * 1e9);
}

core::RockState RemoteRock::place(const std::vector<Pose>& X_WB) { return move(0, X_WB); }

core::RockState RemoteRock::step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) {
  return move(n_steps, X_WB_target);
}

core::RockState RemoteRock::move(std::int64_t n_steps, const std::vector<Pose>& X_WB) {
  core::TargetMotion request;
  request.n_steps = n_steps;
  request.contact = contact_;
  for (const auto& X : X_WB) request.bodies.push_back({X, Twist{}});
  const std::int64_t t_end_ns = now_.t_ns + n_steps * dt_ns_;
  auto m = take<core::WallWrench>(link_.ask(std::move(request), now_.step_index, t_end_ns),
                                  link_.side());
  return {m.dem_step, m.dem_step * dt_ns_, std::move(m.bodies), std::move(m.channels)};
}

void RemoteRock::save(const std::filesystem::path& file) {
  command(link_, core::Action::save, file, now_);
}
std::string RemoteRock::state_hash() { return command(link_, core::Action::hash, "", now_); }
void RemoteRock::stop() {
  link_.tell(core::Command{core::Action::stop, ""}, now_.step_index, now_.t_ns);
}

}  // namespace dipper::transport
