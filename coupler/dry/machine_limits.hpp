// How close a run came to the machine's limits.
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
  double at_s = 0;   ///< time of the largest
  double limit = 0;
  double over_s = 0;  ///< total time above the limit
};

/// Of force, power and speed of hoist, crowd and swing. Throws std::runtime_error naming the record
/// and the dataset.
std::vector<LimitUse> limit_uses(const std::filesystem::path& record,
                                 const machine::MachineData& machine);

}  // namespace dipper::dry
