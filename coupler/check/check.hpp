// dipper check: checks that need several parts of a case.
#pragma once

#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::check {

/// Checks that need several parts: files that exist, meshes that are closed and sound, and
/// the YAML files beside them, motion within limits, a stable DEM step, walls that stay in the
/// box, classes with at least one rock. Expects a case that loaded without findings.
std::vector<Finding> check_case(const cases::Case& c);

}  // namespace dipper::check
