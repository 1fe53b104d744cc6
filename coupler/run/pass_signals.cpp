#include "coupler/run/pass_signals.hpp"

#include <cmath>

#include "common/record/record.hpp"

namespace dipper::run {

analysis::signals::PassSignals read_pass_signals(const std::filesystem::path& record) {
  analysis::signals::PassSignals s;
  s.time_s = record::read_channel(record, "time_s");
  s.door_rad = record::read_channel(record, "machine/door");
  s.hoist_force_N = record::read_channel(record, "machine/hoist_force");
  s.crowd_force_N = record::read_channel(record, "machine/crowd_force");
  s.dipper_mass_kg = record::read_channel(record, "rock/mass_in_dipper");
  s.truck_mass_kg = record::read_channel(record, "rock/mass_in_truck");
  const auto fx = record::read_channel(record, "bodies/dipper/wrench_mean", 3);
  const auto fy = record::read_channel(record, "bodies/dipper/wrench_mean", 4);
  const auto fz = record::read_channel(record, "bodies/dipper/wrench_mean", 5);
  for (std::size_t i = 0; i < fx.size(); ++i) {
    s.dipper_force_N.push_back(std::hypot(fx[i], fy[i], fz[i]));
  }
  return s;
}

}  // namespace dipper::run
