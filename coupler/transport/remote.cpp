#include "coupler/transport/remote.hpp"

#include "coupler/setup/info_json.hpp"

namespace dipper::transport {
namespace {

template <class Expected>
Expected take(core::Body body, const Link& link) {
  if (auto* expected = std::get_if<Expected>(&body)) return std::move(*expected);
  throw PeerError(link.side(), "answered with the wrong kind of message");
}

}  // namespace

template <class Side>
Remote<Side>::Remote(Link& link)
    : link_(link), info_(setup::info_from_json(command(core::Action::hello))) {
  link_.bodies = info_.bodies;
}

template <class Side>
std::string Remote<Side>::command(core::Action action, const std::string& text) {
  return take<core::Status>(link_.ask(core::Command{action, text}, step_index_, t_ns_), link_).text;
}

template class Remote<core::Machine>;
template class Remote<core::Rock>;

core::MachineState RemoteMachine::state(std::int64_t t_next_ns) {
  return take<core::MachineState>(
      link_.ask(core::Command{core::Action::state, ""}, step_index_, t_next_ns), link_);
}

core::MachineState RemoteMachine::step(const core::MachineStep& step) {
  step_index_ = step.step_index + 1;
  t_ns_ = step.t_end_ns;
  return take<core::MachineState>(link_.ask(step, step.step_index, step.t_end_ns), link_);
}

core::RockState RemoteRock::place(const std::vector<Pose>& X_WB) {
  return take<core::RockState>(link_.ask(core::RockPlace{X_WB}, 0, 0), link_);
}

void RemoteRock::start(const core::RockStep& step) {
  step_index_ = step.step_index + 1;
  t_ns_ = step.t_end_ns;
  link_.send(step, step.step_index, step.t_end_ns);
}

core::RockState RemoteRock::finish() { return take<core::RockState>(link_.receive(), link_); }

}  // namespace dipper::transport
