// The paper's contact law (Svanberg et al. 2021, Eqs. 3-8) as LIGGGHTS coefficients.
//
// LIGGGHTS `model hooke/stiffness tangential history rolling_friction epsd2 limitForce on`, for a
// pair of types, with m = m1 m2/(m1 + m2) of the two *bodies* (a sub-sphere counts with the mass
// of its rock; against a wall m is the body's mass):
//
//   F_n = kn d_n - gamman m v_n        Eq. 3, so gamman = c_n/m = 2 D_n sqrt(kn/m)       (Eq. 6)
//   F_t = kt s_t - gammat m v_t        kt = C_tan kn, gammat = 2 D_t sqrt(kt/m)
//   M  <= mu' r1 r2/(r1 + r2) kn d_n   rolling; against a wall mu' r kn d_n              (Eq. 8)
//
// M is reached through a spring, K_r = kt (r1 r2/(r1 + r2))^2 (Iwashita & Oda 1998): steady rolling
// meets all of Eq. 8, and a rock at rest stays at rest. LIGGGHTS's cdt, Eq. 8 literally, turns M
// against the last step's spin, which never decays: docs/rock_evidence.md.
//
// limitForce keeps F_n >= 0: rock does not stick. tests/coupler/deck/two_body_test and rolling_test
// compare each line with its closed form. LIGGGHTS differs from the paper:
// - Eq. 7 bounds the spring only. While it is at mu F_n there is no damping; before, the damper is
//   unbounded, so that a first touch at a grazing angle (v_t = 10 v_n, D as in the paper) gives 2.7
//   times the tangential impulse of mu. Rock that already slides is not affected.
// - M has the spring's force only, not the dashpot's: the same at rest.
// - K_n is per touching sub-sphere. A rock flat on n of its spheres is n times as stiff, and its
//   damping sqrt(n) times as great a share of critical.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::deck {

/// Porosity of the settled pile.
double porosity(const cases::Case& c);

/// Mass of a rock with the fines that move with it, over the rock's volume: rho (1 + phi e). The
/// fines fill the share phi of the voids e and are packed as densely as the rock, so the pile's
/// bulk density rho (1 - e) becomes rho (1 - e)(1 + phi e).
double laden_density(const cases::Case& c);

/// The stress that separates two moist rocks, F/d^2 [Pa]. A packing of porosity e and diameter d
/// has the tensile strength s when F = s d^2 e/(1 - e) (Rumpf 1962, with his e k = pi for the
/// coordination number k). Strength does not change under coarse graining.
double pull_off_stress(double tensile_strength_Pa, double porosity);

/// Whether the rock needs the cohesion model `moist`: moist, or with a crust.
bool needs_cohesion_model(const cases::Case& c);

/// All bodies of a class have one mass: size is the volume-equivalent diameter.
struct RockClass {
  double radius_m = 0;  ///< volume-equivalent, coarse-grained
  double mass_kg = 0;
  bool is_sphere = false;
};

/// The simulated size: times coarse_graining, but not enlarged beyond coarse_graining_limit_m.
double grained_size_m(const cases::RockCase& rock, double size_m);

/// One per case.rock.classes, in order. Throws std::invalid_argument for a class that mixes spheres
/// and other shapes, or has no shape.
std::vector<RockClass> rock_classes(const cases::Case& c);

/// The LIGGGHTS atom types: 1 ... n the size classes, then the walls.
struct AtomTypes {
  int classes = 0;
  int dipper() const { return classes + 1; }
  int ground() const { return classes + 2; }
  int truck() const { return classes + 3; }
  int sides() const { return classes + 4; }  ///< frictionless
  int count() const { return classes + 4; }
};
AtomTypes atom_types(const cases::Case& c);

/// Symmetric; row and column are type - 1. Walls never touch each other: zero.
struct ContactTable {
  Eigen::MatrixXd kn;           ///< N/m
  Eigen::MatrixXd kt;           ///< N/m
  Eigen::MatrixXd gamman;       ///< 1/s
  Eigen::MatrixXd gammat;       ///< 1/s
  Eigen::MatrixXd friction;     ///< mu, Eq. 7
  Eigen::MatrixXd rolling;      ///< mu'
  Eigen::MatrixXd meff_kg;      ///< m above, as used for gamman
  Eigen::MatrixXd pull_off_Pa;  ///< of moist rock: force by diameter squared; 0 on the sides
};

/// K_n = C k1 r1 k2 r2/(k1 r1 + k2 r2), k = E/(3(1 - 2 nu)) (Eqs. 4, 5); a wall is the limit of the
/// same k and an infinite radius, K_n = C k r.
///
/// Rolling: the paper's M = mu_r r F_n with the sphere's own radius r (the smaller of two).
/// LIGGGHTS uses r1 r2/(r1 + r2), so mu' = mu_r (1 + r/R) with the partner's radius R: 2 mu_r for
/// equal spheres, mu_r on walls. Against a rock R is its volume-equivalent radius; the touching
/// sub-sphere has another, b, so the torque is (1 + r/R)/(1 + r/b) times Eq. 8's: 0.75 at
/// b = 0.55 R, r = 2 R/3. Rocks among themselves and on walls have none.
ContactTable contact_table(const cases::Case& c);

}  // namespace dipper::deck
