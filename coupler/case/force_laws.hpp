// observation.hoist_law, .crowd_law: maps of numbers whose names are terms of the motion.
#pragma once

#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/case/schema.hpp"

namespace dipper::cases {

/// Whether a key's name (`*`) has to be a term of the motion.
bool is_law(const KeySpec& spec);

/// Why a name that is none cannot be taken, with the nearest that is.
std::string no_term(const std::string& name);

/// A finding for each name in the case's laws that is no term.
void check_force_laws(const Case& c, std::vector<Finding>& findings);

}  // namespace dipper::cases
