// Moves spheres and multispheres through a step, in place of LIGGGHTS's three fixes for it.
#pragma once

#include <vector>

#include "dem/fast/border_exchange.hpp"

namespace LAMMPS_NS {
class Fix;
class FixGravity;
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// Does what `fix nve/sphere`, `fix multisphere` and `fix gravity` do between two force
/// computations, sum for sum, so that every number is the same to the bit. It avoids the
/// searches: LIGGGHTS looks up the body, the periodic image and the group of every sphere in each
/// of seven passes over all of them. Here a body knows its spheres, held rock is not moved, and the
/// spheres of bodies get the velocity of the step's end only when it is read.
class RockMotion {
 public:
  explicit RockMotion(LAMMPS_NS::LAMMPS& lmp) : lmp_(lmp), border_(lmp) {}

  /// Call at the start of a run, before LIGGGHTS lists which fixes to call. Returns false when the
  /// deck has something unsupported (another integrator, a periodic box, a rock stream): LIGGGHTS's
  /// fixes are used then.
  bool take_over();

  /// Call when lists are built: finds the spheres of each body, and which rock moves. Collective.
  void gather();

  LAMMPS_NS::FixMultisphere& bodies() { return *fix_bodies_; }

  /// The first half of a step. Returns the largest speed of a sphere's centre, on this rank [m/s].
  double initial_integrate();

  /// Sends the new positions of spheres near other ranks to those.
  void forward();

  /// The second half, from forces without gravity. Unless the step is `seen`, velocities change
  /// with the next step's first half, spheres of bodies do not get theirs, nor rock at rest its
  /// forces.
  void final_integrate(bool seen);

  /// Call when no further step follows.
  void finish();

  /// The same by LIGGGHTS itself, for a step that needs its virial.
  void library_initial_integrate(int vflag);
  void library_final_integrate(int vflag);

 private:
  struct Sphere {
    int index;
    double dtf_m, dtf_I;  ///< half a step, over mass and over moment of inertia
  };
  /// Of the bodies on this rank, one entry a body.
  struct Bodies {
    int n = 0;
    double **x = nullptr, **v = nullptr, **force = nullptr, **torque = nullptr;
    double **angmom = nullptr, **omega = nullptr, **quat = nullptr, **inertia = nullptr;
    double **ex = nullptr, **ey = nullptr, **ez = nullptr, *mass = nullptr;
    bool **moves = nullptr, **turns = nullptr;
  };

  bool held(int body) const;
  double move_spheres();
  double move_bodies();
  void kick(bool seen);
  void kick_sphere(const Sphere& s);
  void kick_body(int b, bool seen);
  void weigh(int sphere);

  LAMMPS_NS::LAMMPS& lmp_;
  BorderExchange border_;
  bool own_border_ = false;
  LAMMPS_NS::FixMultisphere* fix_bodies_ = nullptr;
  LAMMPS_NS::Fix* fix_spheres_ = nullptr;
  LAMMPS_NS::FixGravity* fix_gravity_ = nullptr;
  double g_[3] = {0, 0, 0};
  bool kick_due_ = false;  ///< the second half of the step before: with the next, both read once
  std::vector<Sphere> free_;
  std::vector<int> held_;  ///< single spheres that are not integrated but have weight
  Bodies bodies_;
  std::vector<int> first_, of_body_;  ///< spheres of body b: of_body_[first_[b] ... first_[b + 1]]
  std::vector<double> place_;  ///< their positions in the body's axes, three numbers each [m]
};

}  // namespace dipper::dem
