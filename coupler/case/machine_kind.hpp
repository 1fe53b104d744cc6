// The consequences of machine.kind: the keys of a case, and the duration of its motion.
#pragma once

#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// True for a key that the case cannot use: a shovel's with machine.kind poses, machine.poses with
/// a shovel, the truck's for poses without a truck.
bool is_of_other_kind(const Case& c, const std::string& key);

/// A finding for every given key that the case cannot use, and for a missing machine.poses.
void check_machine_kind(const Case& c, std::vector<Finding>& findings);

inline bool has_truck(const Case& c) { return !c.truck.mesh.empty(); }

/// The last time of the motion or of the poses [s]. Throws InputError for a file that cannot be
/// read.
double motion_end_s(const Case& c);

}  // namespace dipper::cases
