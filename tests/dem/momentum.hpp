// Mass, momentum and angular momentum of all rock, straight from LIGGGHTS's arrays.
#pragma once

#include <atom.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <modify.h>
#include <mpi.h>

#include "common/frames.hpp"

namespace dipper::test {

struct Momentum {
  double mass = 0;                      ///< [kg]
  Vector3d moment = Vector3d::Zero();   ///< sum of m x [kg m]
  Vector3d linear = Vector3d::Zero();   ///< [N s]
  Vector3d angular = Vector3d::Zero();  ///< about W's origin, spin included [N m s]
  double bodies = 0;                    ///< multispheres
};

/// Summed over all ranks. Collective.
inline Momentum momentum(LAMMPS_NS::LAMMPS& lmp) {
  using Row = Eigen::Map<const Vector3d>;
  Momentum sum;
  const auto add = [&](double m, const Vector3d& x, const Vector3d& v, const Vector3d& spin) {
    sum.mass += m;
    sum.moment += m * x;
    sum.linear += m * v;
    sum.angular += m * x.cross(v) + spin;
  };
  auto* multisphere =
      static_cast<LAMMPS_NS::FixMultisphere*>(lmp.modify->find_fix_style("multisphere", 0));
  const LAMMPS_NS::Atom& atom = *lmp.atom;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (multisphere != nullptr && multisphere->belongs_to(i) >= 0) continue;
    const double inertia = 0.4 * atom.rmass[i] * atom.radius[i] * atom.radius[i];
    add(atom.rmass[i], Row(atom.x[i]), Row(atom.v[i]), inertia * Row(atom.omega[i]));
  }
  if (multisphere != nullptr) {
    auto& data = multisphere->data();
    sum.bodies = data.n_body();
    for (int b = 0; b < data.n_body(); ++b) {
      Vector3d x, v, spin;
      data.xcm(x.data(), b);
      data.vcm(v.data(), b);
      data.angmom(spin.data(), b);
      add(data.mass(b), x, v, spin);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &sum, sizeof sum / sizeof(double), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  return sum;
}
static_assert(sizeof(Momentum) == 11 * sizeof(double));

}  // namespace dipper::test
