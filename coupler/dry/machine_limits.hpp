// How near a run came to what the machine can do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "machine/machine_data.hpp"

namespace dipper::dry {

/// One limit of the machine's data (`drives`, `limits`), over a whole run.
struct LimitUse {
  std::string name;  ///< as "hoist_force"
  std::string unit;  ///< SI
  double most = 0;   ///< largest magnitude
  double at_s = 0;   ///< when
  double limit = 0;
  double over_s = 0;  ///< for how long it was above
};

/// Of force, power and speed of hoist, crowd and swing. Throws std::runtime_error naming the record
/// and the dataset.
std::vector<LimitUse> limit_uses(const std::filesystem::path& record,
                                 const machine::MachineData& machine);

}  // namespace dipper::dry
