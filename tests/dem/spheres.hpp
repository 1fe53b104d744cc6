// Places of and forces on every sphere, wherever it is.
#pragma once

#include <atom.h>
#include <lammps.h>
#include <mpi.h>

#include <vector>

#include "common/frames.hpp"

namespace dipper::dem {

/// Centre and total force of every sphere, by id; the same on every rank.
struct Spheres {
  std::vector<Vector3d> x, f;
};

/// \param gravity  of the scene, m/s2: its weight is taken off the force, which then is of contacts
inline Spheres spheres(LAMMPS_NS::LAMMPS& lmp, const Vector3d& gravity = Vector3d::Zero()) {
  const LAMMPS_NS::Atom& atom = *lmp.atom;
  const auto n = static_cast<std::size_t>(lmp.atom->tag_max()) + 1;
  Spheres s{std::vector<Vector3d>(n, Vector3d::Zero()), std::vector<Vector3d>(n, Vector3d::Zero())};
  for (int i = 0; i < atom.nlocal; ++i) {
    const auto tag = static_cast<std::size_t>(atom.tag[i]);
    s.x[tag] = Eigen::Map<const Vector3d>(atom.x[i]);
    s.f[tag] = Eigen::Map<const Vector3d>(atom.f[i]) - atom.rmass[i] * gravity;
  }
  for (auto* v : {&s.x, &s.f})
    MPI_Allreduce(MPI_IN_PLACE, v->data(), static_cast<int>(3 * n), MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
  return s;
}

}  // namespace dipper::dem
