// How long a DEM step may be.
#pragma once

#include "coupler/deck/contact_table.hpp"

namespace dipper::deck {

/// The longest step [s] at which one damped contact of angular frequency omega = sqrt(K/m) [1/s]
/// and damping ratio zeta stays bounded in LIGGGHTS's velocity Verlet. There the force is computed
/// from the half-step velocity, which lags: with u the half-step velocity,
///   u' = u (1 - 2 zeta W) - omega W x,  x' = x + dt u',  W = omega dt,
/// whose eigenvalues stay in the unit circle for W < 2 (sqrt(1 + zeta^2) - zeta). Without damping
/// that is the familiar 2; at zeta = 0.9 it is 0.89.
double critical_step(double omega, double zeta);

/// The step [s] that keeps the bulk bounded: critical_step of the fastest pair of the table with
/// kContacts contacts working on the same motion, which multiplies stiffness and damping:
/// omega sqrt(n), zeta sqrt(n). For equal spheres and D_n = 0.9 it is 0.18 sqrt(m/K_n); the paper
/// ran 4.5e-5 s = 0.11 sqrt(m/K_n) (section 4). The mass in a contact is the whole rock's, so light
/// sub-spheres do not shorten the step.
double stable_timestep(const cases::Case& c);

/// Measured on the small bench of tests/coupler/deck at D_n = 0.9: with 0.9 of this step the rock
/// comes to rest as with 0.3, with 1.2 almost, with 1.5 it keeps trembling, with 1.8 the bench
/// boils. With 12 and 24 spheres a rock in place of 6 it rests up to 1.0 and trembles from 1.2 on.
inline constexpr int kContacts = 4;

/// The longest step [s] for a rock pressed between two walls, such as dipper and ground, with all
/// its spheres on both: critical_step with twice its spheres as contacts. From it on the rock
/// throws itself from wall to wall in turn, and presses several times as hard as at rest
/// (tests/coupler/deck/squeezed_rock_test). Infinite where no rock has several spheres. Such rocks
/// are few, so a case may have a longer step: run::Rattle tells what they do to its forces.
double pressed_timestep(const cases::Case& c);

/// What `dem.timestep_s: auto` stands for: 0.85 of the stable step, to two digits. At 0.86 of it
/// cases/aitik digs at true size.
double chosen_timestep(const cases::Case& c);

}  // namespace dipper::deck
