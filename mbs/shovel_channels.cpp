#include "mbs/shovel_channels.hpp"

namespace dipper::mbs {

std::vector<core::Channel> shovel_channels(const Operator* from) {
  std::vector<core::Channel> channels = {
      {"swing", "rad", "W"},
      {"swing_rate", "rad/s", "W"},
      {"saddle_pitch", "rad", "H"},
      {"saddle_rate", "rad/s", "H"},
      {"crowd", "m", "-"},
      {"crowd_rate", "m/s", "-"},
      {"door", "rad", "B"},
      {"door_rate", "rad/s", "B"},
      {"hoist", "m", "-"},
      {"hoist_rate", "m/s", "-"},
      {"rope_tension_left", "N", "-"},
      {"rope_tension_right", "N", "-"},
      {"hoist_force", "N", "-"},
      {"crowd_force", "N", "-"},
      {"swing_torque", "N m", "W"},
      {"door_torque", "N m", "B"},
      {"hoist_power", "W", "-"},
      {"crowd_power", "W", "-"},
      {"swing_power", "W", "-"},
      {"door_power", "W", "-"},
      {"kinetic_energy", "J", "-"},
      {"potential_energy", "J", "-"},
      {"interface_power", "W", "-"},
      {"dissipated_power", "W", "-"},
      {"drive_work", "J", "-"},
      {"interface_work", "J", "-"},
      {"dissipated_energy", "J", "-"},
      {"energy_residual", "J", "-"},
  };
  if (from != nullptr) {
    const std::vector<core::Channel> own = from->channels();
    channels.insert(channels.end(), own.begin(), own.end());
    channels.insert(channels.end(), {{"hoist_saturated", "1", "-"},
                                     {"crowd_saturated", "1", "-"},
                                     {"swing_saturated", "1", "-"},
                                     {"ropes_slack", "1", "-"}});
  }
  return channels;
}

}  // namespace dipper::mbs
