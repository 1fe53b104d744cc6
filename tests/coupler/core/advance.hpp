#pragma once

#include "coupler/core/coupling.hpp"

namespace dipper::core {

/// A window of n_steps DEM steps, and another of as many to come.
inline Window advance(Coupling& coupling, std::int64_t n_steps) {
  coupling.begin(n_steps);
  return coupling.finish(n_steps);
}

}  // namespace dipper::core
