// What is legal in a case and yet makes no sense: a user has to see it, and may know better.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::check {

/// Every warning about a case that check_case found nothing wrong with.
std::vector<Finding> warnings(const cases::Case& c);

}  // namespace dipper::check
