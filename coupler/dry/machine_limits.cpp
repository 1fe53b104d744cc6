#include "coupler/dry/machine_limits.hpp"

#include <algorithm>
#include <cmath>

#include "common/record/columns.hpp"

namespace dipper::dry {
namespace {

constexpr double kRounding = 1e-9;  // of a drive that is at its limit

}  // namespace

std::vector<LimitUse> limit_uses(const std::filesystem::path& record,
                                 const machine::MachineData& machine) {
  const auto& d = machine.drives;
  const auto& l = machine.limits;
  std::vector<LimitUse> uses;
  for (const auto& [name, unit, limit] : {std::tuple{"hoist_force", "N", d.hoist.stall},
                                          {"crowd_force", "N", d.crowd.stall},
                                          {"swing_torque", "N m", d.swing.stall},
                                          {"hoist_power", "W", d.hoist.power},
                                          {"crowd_power", "W", d.crowd.power},
                                          {"swing_power", "W", d.swing.power},
                                          {"hoist_rate", "m/s", l.hoist_speed},
                                          {"crowd_rate", "m/s", l.crowd_speed},
                                          {"swing_rate", "rad/s", l.swing_speed}})
    uses.push_back({name, unit, 0, 0, limit, 0});
  record::Columns columns(record);
  columns.read("time_s");
  for (const LimitUse& use : uses) columns.read("machine/" + use.name);
  const auto time_s = columns.get("time_s");
  for (LimitUse& use : uses) {
    const auto values = columns.get("machine/" + use.name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double v = std::abs(values[i]);
      if (v > (1 + kRounding) * use.limit && i > 0) use.over_s += time_s[i] - time_s[i - 1];
      if (v <= use.most) continue;
      use.most = v;
      use.at_s = time_s[i];
    }
  }
  return uses;
}

}  // namespace dipper::dry
