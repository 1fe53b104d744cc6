// Removes rock from the simulation permanently.
#pragma once

#include <functional>
#include <vector>

#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// The removed rock; the same on every rank.
struct Cleared {
  double rocks = 0;  ///< multispheres and single spheres
  double mass_kg = 0;
};

/// Of a sphere's centre [m, in W] and radius [m].
using SphereTest = std::function<bool(const Vector3d& p_W, double radius_m)>;

/// Removes every rock of which a sphere passes the test, as a whole. Collective. The caller sets up
/// lists and forces: before the first run, by that run; between steps, call this between
/// Modify::setup_pre_exchange, which stores contact history, and Integrate::setup_minimal.
Cleared remove_rock(LAMMPS_NS::LAMMPS& lmp, const SphereTest& goes);

/// Whether a sphere overlaps one of the closed walls, or lies inside its steel.
SphereTest overlaps(const std::vector<mesh::TriangleMesh>& walls_W);

}  // namespace dipper::dem
