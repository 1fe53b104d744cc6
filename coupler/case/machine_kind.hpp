// What machine.kind decides: which keys a case has, and how long its motion lasts.
#pragma once

#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// True for a key that the case cannot use: a shovel's with machine.kind poses, machine.poses with
/// a shovel, the truck's where poses are without a truck.
bool is_of_other_kind(const Case& c, const std::string& key);

/// Every key that is given and of another kind, and machine.poses where it is missing, becomes a
/// finding.
void check_machine_kind(const Case& c, std::vector<Finding>& findings);

inline bool has_truck(const Case& c) { return !c.truck.mesh.empty(); }

/// The last time of the motion or of the poses [s]. Throws InputError for a file that cannot be
/// read.
double motion_end_s(const Case& c);

}  // namespace dipper::cases
