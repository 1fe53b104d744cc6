// Forces between rocks that stick: moist fines between them, and a frozen or compacted crust.
//
// LIGGGHTS's own cohesion models do not fit a linear spring. SJKR and SJKR2 pull with a constant
// times the overlap, which only makes the spring softer: there is no pull at the moment of
// separation. The capillary ones use liquid and surface tension, which hold grains of
// millimetres, not boulders: 2 pi R 0.072 N/m is 0.05 N for R = 0.1 m, against a weight of 150 N.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dipper::dem::moist {

using Eigen::Vector3d;

/// Effective diameter of a pair: harmonic mean, 4 r1 r2/(r1 + r2); a sphere's own for equal ones.
inline double pair_diameter(double r1, double r2) { return 4 * r1 * r2 / (r1 + r2); }

/// How far moist fines stretch before they separate, as a share of the sum of the radii. Assumed; a
/// bridge of 1e-5 of the sphere's volume ruptures at about V^(1/3) = 0.02 d (Lian et al. 1993).
constexpr double kReach = 0.02;

/// Attraction of moist fines, >= 0: full while the surfaces touch (gap <= 0), then falling to zero
/// at reach_m. It depends on the gap alone, so it creates no energy and needs no history.
inline double moist_pull(double pull_off_N, double gap_m, double reach_m) {
  if (gap_m <= 0) return pull_off_N;
  return gap_m < reach_m ? pull_off_N * (1 - gap_m / reach_m) : 0.0;
}

/// A cemented disc between two spheres (Potyondy and Cundall 2004, Int. J. Rock Mech. 41:1329,
/// Eqs. 12-17), of the smaller sphere's radius and as stiff as the contact it lies in. That contact
/// carries compression: the disc's own normal force is tension only.
struct Bond {
  double radius_m = 0, kn = 0, kt = 0;  ///< N/m
  double area() const { return M_PI * radius_m * radius_m; }
  double bending() const { return kn * radius_m * radius_m / 4; }   ///< kn I/A, N m/rad
  double twisting() const { return kt * radius_m * radius_m / 2; }  ///< kt J/A, N m/rad
};

/// The disc's deformation since it formed; n points from sphere 2 to sphere 1.
struct Strain {
  double gap_m = 0;                      ///< elongation
  Vector3d shear_m = Vector3d::Zero();   ///< of 1 against 2, normal to n
  Vector3d turn_rad = Vector3d::Zero();  ///< of 1 against 2
};

/// Largest tensile and shear stress in the disc: of tension and bending, of shear and twisting.
struct Stress {
  double tensile_Pa = 0, shear_Pa = 0;
};
inline Stress bond_stress(const Bond& b, const Strain& s, const Vector3d& n) {
  const Vector3d twist = s.turn_rad.dot(n) * n;
  const double R = b.radius_m, inertia = b.area() * R * R / 4;
  const double tension = b.kn * std::max(0.0, s.gap_m), shear = b.kt * s.shear_m.norm();
  return {tension / b.area() + b.bending() * (s.turn_rad - twist).norm() * R / inertia,
          shear / b.area() + b.twisting() * twist.norm() * R / (2 * inertia)};
}

/// Force and moment on sphere 1 at the disc, without damping.
struct BondLoad {
  Vector3d force, moment;
};
inline BondLoad bond_load(const Bond& b, const Strain& s, const Vector3d& n) {
  const Vector3d twist = s.turn_rad.dot(n) * n;
  return {-b.kn * std::max(0.0, s.gap_m) * n - b.kt * s.shear_m,
          -b.bending() * (s.turn_rad - twist) - b.twisting() * twist};
}

}  // namespace dipper::dem::moist
