#include "coupler/operate/operated_machine.hpp"

#include <fstream>
#include <stdexcept>
#include <utility>

#include "common/json_text.hpp"
#include "common/json_values.hpp"
#include "common/seconds.hpp"
#include "common/text_file.hpp"

namespace dipper::operate {
namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
namespace {

/// Beside a machine's state: a line of ours, and the program's own as it said it.
fs::path beside(const fs::path& machine_state) {
  return machine_state.parent_path() / "operator.state";
}

std::pair<nlohmann::json, std::string> read_state(const fs::path& machine_state) {
  const fs::path file = beside(machine_state);
  std::ifstream in(file);
  std::string ours, its;
  if (!std::getline(in, ours) || !std::getline(in, its))
    throw std::runtime_error(file.string() +
                             ": cannot be read; a program did not drive this run so far");
  try {
    return {parse_json(ours), its};
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(file.string() + ": " + e.what());
  }
}

json limits_of(const machine::MachineData& m) {
  const machine::MachineData::Limits& l = m.limits;
  return {{"hoist_m", {l.hoist_min, l.hoist_max}},
          {"crowd_m", {l.crowd_min, l.crowd_max}},
          {"door_rad", {l.door_min, l.door_max}},
          {"hoist_m_s", l.hoist_speed},
          {"crowd_m_s", l.crowd_speed},
          {"swing_rad_s", l.swing_speed},
          {"hoist_stall_N", m.drives.hoist.stall},
          {"hoist_power_W", m.drives.hoist.power},
          {"crowd_stall_N", m.drives.crowd.stall},
          {"crowd_power_W", m.drives.crowd.power},
          {"swing_stall_N_m", m.drives.swing.stall},
          {"swing_power_W", m.drives.swing.power}};
}

json named(const core::ServerInfo& info, const std::vector<double>& channels) {
  json all = json::object();
  for (std::size_t k = 0; k < info.channels.size() && k < channels.size(); ++k)
    all[info.channels[k].name] = channels[k];
  return all;
}

}  // namespace

OperatedMachine::OperatedMachine(core::Machine& inner, const Operated& setup, bool resumed,
                                 const RockTruth& truth)
    : inner_(inner),
      setup_(setup),
      truth_(truth),
      conversation_(setup.program, setup.log, setup.patience),
      instruments_(inner.info(), setup.machine, setup.rake),
      answers_(setup.machine, setup.rake),
      now_(inner.state(0)) {
  if (!resumed) greet("");
}

void OperatedMachine::greet(const std::string& state) {
  conversation_.greet({{"case", setup_.case_name},
                       {"machine", setup_.machine.machine},
                       {"motion", setup_.motion.string()},
                       {"look_s", seconds(kLook_ns)},
                       {"limits", limits_of(setup_.machine)},
                       {"truth", setup_.program.sees_truth}},
                      state);
}

core::MachineState OperatedMachine::state(std::int64_t t_next_ns) {
  return now_ = inner_.state(t_next_ns);
}

core::MachineState OperatedMachine::step(const core::MachineStep& step) {
  core::MachineStep ordered = step;
  const std::int64_t look = now_.t_ns / kLook_ns;
  if (look != looked_ && !done_) {
    ordered.order = this->look();
    looked_ = look;
  }
  now_ = inner_.step(ordered);
  instruments_.see(now_);
  return now_;
}

core::Order OperatedMachine::look() {
  const std::int64_t by_ns = (now_.t_ns / kLook_ns + 1) * kLook_ns;
  json shown = instruments_.show(now_);
  shown["by_s"] = seconds(by_ns);
  if (setup_.program.sees_truth) shown["truth"] = truth();
  const std::string said = conversation_.look(shown);
  instruments_.looked();
  try {
    const Answer answer = answers_.read(said, now_.t_ns, by_ns, instruments_.sent(now_));
    done_ = answer.done;
    return answer.order;
  } catch (const std::exception& e) {
    conversation_.fail(e.what());
  }
}

json OperatedMachine::truth() const {
  const core::ServerInfo info = inner_.info();
  json bodies = json::object();
  for (std::size_t b = 0; b < info.bodies.size(); ++b)
    bodies[info.bodies[b]] = json_of(now_.bodies.at(b).X_WB);
  return {{"machine", named(info, now_.channels)},
          {"bodies", bodies},
          {"rock", named(truth_.info, truth_.state().channels)}};
}

void OperatedMachine::save(const fs::path& file) {
  inner_.save(file);
  const nlohmann::json ours = {
      {"looked", looked_}, {"done", done_}, {"instruments", instruments_.memory()}};
  write_text(beside(file), ours.dump() + '\n' + conversation_.save() + '\n');
}

void OperatedMachine::load(const fs::path& file) {
  const auto [ours, its] = read_state(file);
  try {
    looked_ = ours.at("looked");
    done_ = ours.at("done");
    instruments_.remember(ours.at("instruments"));
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(beside(file).string() + ": " + e.what());
  }
  inner_.load(file);
  greet(its);
}

bool had_done(const fs::path& machine_state) {
  return read_state(machine_state).first.value("done", false);
}

}  // namespace dipper::operate
