#include "coupler/operate/instruments.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/door.hpp"

namespace dipper::operate {

using json = nlohmann::ordered_json;

std::string position_key(const DriveWords& drive) {
  return std::string(drive.channel) + '_' + drive.unit;
}

std::string rate_key(const DriveWords& drive) { return position_key(drive) + "_s"; }

Instruments::Instruments(const core::ServerInfo& info, const machine::MachineData& machine,
                         double rake)
    : info_(info), statics_(machine, rake) {
  core::channel_index(info_, "sent_hoist");
}

double Instruments::channel(const core::MachineState& state, const std::string& name) const {
  return state.channels.at(core::channel_index(info_, name));
}

machine::Drives Instruments::drives(const core::MachineState& state,
                                    const std::string& before) const {
  machine::Drives all;
  for (const DriveWords& d : kDriveWords) all.*d.drive = channel(state, before + d.channel);
  return all;
}

machine::Drives Instruments::sent(const core::MachineState& state) const {
  return drives(state, "sent_");
}

double Instruments::load_kg(const core::MachineState& state) const {
  try {
    return statics_.load_kg(drives(state, ""), channel(state, "hoist_force"));
  } catch (const std::domain_error&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

void Instruments::see(const core::MachineState& state) {
  const bool open = machine::door_is_open(channel(state, "door"));
  if (dumps_ && !open) ++pass_;
  was_shut_ = was_shut_ || !open;
  dumps_ = open && was_shut_;
  if (const double load = load_kg(state); std::isfinite(load)) {
    load_sum_kg_ += load;
    ++loads_;
  }
}

void Instruments::looked() {
  load_sum_kg_ = 0;
  loads_ = 0;
}

json Instruments::show(const core::MachineState& state) const {
  json out = {{"time_s", seconds(state.t_ns)}, {"pass", pass_}};
  for (const DriveWords& d : kDriveWords) {
    const std::string name = d.channel;
    out[position_key(d)] = channel(state, name);
    out[rate_key(d)] = channel(state, name + "_rate");
    out["sent_" + position_key(d)] = channel(state, "sent_" + name);
  }
  for (const auto& [name, force, unit] :
       {std::array{"hoist", "force", "N"}, {"crowd", "force", "N"}, {"swing", "torque", "N_m"}}) {
    const std::string drive = name;
    out[drive + '_' + force + '_' + unit] = channel(state, drive + '_' + force);
    out[drive + "_power_W"] = channel(state, drive + "_power");
    out[drive + "_overload"] = channel(state, drive + "_overload");
  }
  const double load = loads_ > 0 ? load_sum_kg_ / loads_ : load_kg(state);
  out["payload_estimate_kg"] = std::isfinite(load) ? json(load) : json(nullptr);
  return out;
}

nlohmann::json Instruments::memory() const {
  return {{"pass", pass_},
          {"was_shut", was_shut_},
          {"dumps", dumps_},
          {"load_sum_kg", load_sum_kg_},
          {"loads", loads_}};
}

void Instruments::remember(const nlohmann::json& memory) {
  pass_ = memory.at("pass");
  was_shut_ = memory.at("was_shut");
  dumps_ = memory.at("dumps");
  load_sum_kg_ = memory.at("load_sum_kg");
  loads_ = memory.at("loads");
}

}  // namespace dipper::operate
