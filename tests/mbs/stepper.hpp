// Fixed-step Runge-Kutta 4 for a Simbody system: the same steps, to the bit, every time.
#pragma once

#include <Simbody.h>

#include <cstdint>
#include <functional>

namespace dipper::mbs {

/// Rates [unit/s] of quantities to integrate along with the motion (works, from powers), at a
/// state realized to Acceleration.
using Quadrature = std::function<SimTK::Vector(const SimTK::State&)>;

/// Sets the time (if it differs) and the prescribed coordinates and speeds, and realizes to
/// Acceleration.
void realize_at(const SimTK::MultibodySystem& system, SimTK::State& state, double t_s);

/// Takes `state` (its q and u as at t0) to t1 in the fewest equal sub-steps no longer than
/// max_substep_ns. Times are computed from the window's integer ends: nothing accumulates.
///
/// A jump of the prescribed accelerations at t0 or t1 is resolved (the last stage sees them from
/// before t1); one inside the window costs accuracy.
///
/// \param integrals adds the integral of `quadrature` over the window; sizes must agree
/// For systems without quaternions, constraints or events.
void advance(const SimTK::MultibodySystem& system, SimTK::State& state, std::int64_t t0_ns,
             std::int64_t t1_ns, std::int64_t max_substep_ns, const Quadrature& quadrature,
             SimTK::Vector& integrals);

}  // namespace dipper::mbs
