// dipper check: what only the parts of a case together tell.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::check {

/// What only the parts together tell: files that exist, meshes that are closed and sound, and
/// what is written beside them, motion within limits, a stable DEM step, walls that stay in the
/// box, classes with at least one rock. Expects a case that loaded without findings.
std::vector<Finding> check_case(const cases::Case& c);

}  // namespace dipper::check
