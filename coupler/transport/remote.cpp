#include "coupler/transport/remote.hpp"

#include "coupler/transport/codec.hpp"

namespace dipper::transport {
namespace {

template <class Expected>
Expected take(core::Body body, const std::string& side) {
  if (auto* expected = std::get_if<Expected>(&body)) return std::move(*expected);
  throw PeerError(side, "answered with the wrong kind of message");
}

core::ServerInfo hello(Link& link) {
  const core::Body answer = link.ask(core::Command{core::Action::hello, ""}, 0, 0);
  core::ServerInfo info = info_from_json(take<core::Status>(answer, link.side()).text);
  link.bodies = info.bodies;
  return info;
}

}  // namespace

RemoteMachine::RemoteMachine(Link& link) : link_(link), info_(hello(link)) {}

core::MachineState RemoteMachine::state(std::int64_t t_next_ns) {
  return take<core::MachineState>(
      link_.ask(core::Command{core::Action::state, ""}, step_index_, t_next_ns), link_.side());
}

core::MachineState RemoteMachine::step(const core::MachineStep& step) {
  step_index_ = step.step_index + 1;
  t_ns_ = step.t_end_ns;
  return take<core::MachineState>(link_.ask(step, step.step_index, step.t_end_ns), link_.side());
}

void RemoteMachine::save(const std::filesystem::path& file) {
  link_.ask(core::Command{core::Action::save, file}, step_index_, t_ns_);
}
void RemoteMachine::load(const std::filesystem::path& file) {
  link_.ask(core::Command{core::Action::load, file}, step_index_, t_ns_);
}
void RemoteMachine::stop() {
  link_.tell(core::Command{core::Action::stop, ""}, step_index_, t_ns_);
}

RemoteRock::RemoteRock(Link& link) : link_(link), info_(hello(link)) {}

core::RockState RemoteRock::place(const std::vector<Pose>& X_WB) {
  return take<core::RockState>(link_.ask(core::RockPlace{X_WB}, 0, 0), link_.side());
}

void RemoteRock::start(const core::RockStep& step) {
  step_index_ = step.step_index + 1;
  t_ns_ = step.t_end_ns;
  link_.send(step, step.step_index, step.t_end_ns);
}

core::RockState RemoteRock::finish() {
  return take<core::RockState>(link_.receive(), link_.side());
}

void RemoteRock::save(const std::filesystem::path& file) {
  link_.ask(core::Command{core::Action::save, file}, step_index_, t_ns_);
}
std::string RemoteRock::state_hash() {
  return take<core::Status>(link_.ask(core::Command{core::Action::hash, ""}, step_index_, t_ns_),
                            link_.side())
      .text;
}
void RemoteRock::stop() { link_.tell(core::Command{core::Action::stop, ""}, step_index_, t_ns_); }

}  // namespace dipper::transport
