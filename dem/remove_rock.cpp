#include "dem/remove_rock.hpp"

#include <atom.h>
#include <atom_vec.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>

#include "common/mesh/signed_distance.hpp"
#include "dem/parked_rock.hpp"

namespace dipper::dem {
namespace {

struct Wall {
  mesh::TriangleMesh mesh;
  Box box;
  bool touches(const Vector3d& p, double radius) const {
    if (((p.array() + radius) < box.min_m.array()).any() ||
        ((p.array() - radius) > box.max_m.array()).any())
      return false;
    return mesh::signed_distance(mesh, p) > -radius;
  }
};

void take_out(LAMMPS_NS::LAMMPS& lmp, const RockNumbers& numbers,
              const std::vector<std::uint8_t>& goes, double& mass_kg) {
  LAMMPS_NS::Atom* atom = lmp.atom;
  atom->map_clear();
  atom->nghost = 0;  // later code would look for the ghosts' ids behind the spheres
  for (int i = 0; i < atom->nlocal;) {
    const int tag = atom->tag[i];
    const std::size_t rock = numbers.of_sphere(tag);
    if (goes[rock] == 0) {
      ++i;
      continue;
    }
    if (rock == static_cast<std::size_t>(tag)) mass_kg += atom->rmass[i];
    atom->avec->copy(atom->nlocal - 1, i, 1);
    --atom->nlocal;
  }
  auto* bodies = multisphere_of(lmp);
  if (bodies == nullptr) return;
  auto& data = bodies->data();
  for (int b = 0; b < data.n_body();) {
    if (goes[numbers.of_body(data.tag(b))] == 0) {
      ++b;
      continue;
    }
    mass_kg += data.mass(b);
    data.remove_body(b);
  }
  data.calc_nbody_all();
}

}  // namespace

Cleared remove_rock(LAMMPS_NS::LAMMPS& lmp, const SphereTest& test) {
  LAMMPS_NS::Atom* atom = lmp.atom;
  const RockNumbers numbers(lmp);
  std::vector<std::uint8_t> goes(numbers.size(), 0);
  for (int i = 0; i < atom->nlocal; ++i)
    if (test(Eigen::Map<const Vector3d>(atom->x[i]), atom->radius[i]))
      goes[numbers.of_sphere(atom->tag[i])] = 1;
  MPI_Allreduce(MPI_IN_PLACE, goes.data(), static_cast<int>(goes.size()), MPI_BYTE, MPI_BOR,
                lmp.world);
  Cleared cleared;
  cleared.rocks = std::accumulate(goes.begin(), goes.end(), 0.0);
  if (cleared.rocks == 0) return cleared;
  take_out(lmp, numbers, goes, cleared.mass_kg);
  MPI_Allreduce(MPI_IN_PLACE, &cleared.mass_kg, 1, MPI_DOUBLE, MPI_SUM, lmp.world);
  LAMMPS_NS::bigint left = atom->nlocal;
  MPI_Allreduce(&left, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lmp.world);
  return cleared;
}

SphereTest overlaps(const std::vector<mesh::TriangleMesh>& walls_W) {
  auto walls = std::make_shared<std::vector<Wall>>();
  for (const mesh::TriangleMesh& mesh : walls_W) walls->push_back({mesh, mesh::bounding_box(mesh)});
  return [walls](const Vector3d& p_W, double radius_m) {
    return std::any_of(walls->begin(), walls->end(),
                       [&](const Wall& w) { return w.touches(p_W, radius_m); });
  };
}

}  // namespace dipper::dem
