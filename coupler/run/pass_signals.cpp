#include "coupler/run/pass_signals.hpp"

#include <cmath>

#include "common/record/columns.hpp"

namespace dipper::run {

analysis::signals::PassSignals read_pass_signals(const std::filesystem::path& record) {
  record::Columns c(record);
  for (const char* channel : {"time_s", "machine/door", "machine/hoist_force",
                              "machine/crowd_force", "rock/mass_in_dipper", "rock/mass_in_truck"})
    c.read(channel);
  for (std::size_t k = 3; k < 6; ++k) c.read("bodies/dipper/wrench_mean", k);
  analysis::signals::PassSignals s;
  s.time_s = c.get("time_s");
  s.door_rad = c.get("machine/door");
  s.hoist_force_N = c.get("machine/hoist_force");
  s.crowd_force_N = c.get("machine/crowd_force");
  s.dipper_mass_kg = c.get("rock/mass_in_dipper");
  s.truck_mass_kg = c.get("rock/mass_in_truck");
  const auto fx = c.get("bodies/dipper/wrench_mean", 3);
  const auto fy = c.get("bodies/dipper/wrench_mean", 4);
  const auto fz = c.get("bodies/dipper/wrench_mean", 5);
  for (std::size_t i = 0; i < fx.size(); ++i) {
    s.dipper_force_N.push_back(std::hypot(fx[i], fy[i], fz[i]));
  }
  return s;
}

}  // namespace dipper::run
