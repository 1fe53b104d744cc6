// Input that is valid but probably a mistake: the user must see it, and decides.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::check {

/// Every warning about a case that check_case found nothing wrong with.
std::vector<Finding> warnings(const cases::Case& c);

}  // namespace dipper::check
