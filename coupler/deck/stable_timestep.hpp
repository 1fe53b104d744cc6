// The longest stable DEM step.
#pragma once

#include "coupler/deck/contact_table.hpp"

namespace dipper::deck {

/// The longest step [s] at which one damped contact of angular frequency omega = sqrt(K/m) [1/s]
/// and damping ratio zeta stays bounded in LIGGGHTS's velocity Verlet. There the force is computed
/// from the half-step velocity u, which lags:
///   u' = u (1 - 2 zeta W) - omega W x,  x' = x + dt u',  W = omega dt,
/// whose eigenvalues stay in the unit circle for W < 2 (sqrt(1 + zeta^2) - zeta). Without damping
/// that is the familiar 2; at zeta = 0.9 it is 0.89.
double critical_step(double omega, double zeta);

/// The step [s] that keeps the bulk bounded: critical_step of the fastest pair of the table with
/// kContacts contacts working on the same motion, which multiplies stiffness and damping:
/// omega sqrt(n), zeta sqrt(n). For equal spheres and D_n = 0.9 it is 0.18 sqrt(m/K_n); the paper
/// ran 4.5e-5 s = 0.11 sqrt(m/K_n) (section 4). The mass in a contact is the whole rock's, so light
/// sub-spheres do not shorten the step.
///
/// The same contacts turn a sphere by their tangential springs and dampers, with K_t, D_t and
/// n = 2/3 kContacts/0.4. That is the shorter step where C_tan or D_t is large, or D_n small: for
/// D_n = 0.9 and C_tan = 0.27 from D_t = 1.1 on, for D_n = 0.9 and D_t = 0.75 from C_tan = 0.5 on.
double stable_timestep(const cases::Case& c);

/// Measured on the small bench of tests/coupler/deck at D_n = 0.9: with 0.9 of this step the rock
/// comes to rest as with 0.3, with 1.2 almost, with 1.5 it keeps vibrating, with 1.8 the bench
/// is thrown up. With 12 and 24 spheres per rock in place of 6 it rests up to 1.0 and vibrates from
/// 1.2 on.
inline constexpr int kContacts = 4;

/// The longest step [s] for a rock pressed between two walls, such as dipper and ground, with all
/// its spheres on both: critical_step with twice its spheres as contacts. With a longer step the
/// rock bounces between the walls, and presses several times as hard as at rest
/// (tests/coupler/deck/squeezed_rock_test). Infinite when no rock has several spheres. Few rocks
/// are pressed so, so a case may have a longer step: run::Rattle measures the effect on its forces.
double pressed_timestep(const cases::Case& c);

/// The value of `dem.timestep_s: auto`: 0.85 of the stable step, to two digits. cases/aitik, at
/// true size, uses 0.86 of it.
double chosen_timestep(const cases::Case& c);

}  // namespace dipper::deck
