#include "dem/rock_look.hpp"

#include <atom.h>
#include <lammps.h>
#include <mpi.h>

#include "dem/holding.hpp"

namespace dipper::dem {

HeightMap look_at_rock(LAMMPS_NS::LAMMPS& lmp, const Holding* holding, const HeightGrid& grid) {
  HeightMap seen(grid);
  const LAMMPS_NS::Atom* atom = lmp.atom;
  for (int i = 0; i < atom->nlocal; ++i)
    seen.add_ball(Eigen::Map<const Vector3d>(atom->x[i]), atom->radius[i]);
  if (holding != nullptr)
    for (const ParkedRock::Sphere& s : holding->parked_spheres()) seen.add_ball(s.p_W, s.radius_m);
  MPI_Allreduce(MPI_IN_PLACE, seen.heights().data(), static_cast<int>(seen.heights().size()),
                MPI_DOUBLE, MPI_MAX, lmp.world);
  return seen;
}

}  // namespace dipper::dem
