#include "dem/clear_start.hpp"

#include <abstract_mesh.h>
#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <fix_mesh_surface.h>
#include <fix_multisphere.h>
#include <fmt/core.h>
#include <lammps.h>
#include <modify.h>
#include <tri_mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "common/mesh/signed_distance.hpp"
#include "dem/parked_rock.hpp"

namespace dipper::dem {
namespace {

/// Before the first run every rank holds the whole mesh, where it has been put.
mesh::TriangleMesh wall(LAMMPS_NS::LAMMPS& lmp, const std::string& id) {
  auto* fix = dynamic_cast<LAMMPS_NS::FixMeshSurface*>(lmp.modify->find_fix_id(id.c_str()));
  if (fix == nullptr)
    throw std::runtime_error("the deck has no `fix " + id + " all mesh/surface ...` to clear");
  LAMMPS_NS::AbstractMesh* mesh = fix->mesh();
  mesh::TriangleMesh out;
  for (int i = 0; i < mesh->sizeLocal(); ++i) {
    mesh::Triangle t;
    for (int j = 0; j < 3; ++j) mesh->node_slow(i, j, t[static_cast<std::size_t>(j)].data());
    out.add_loose(t);
  }
  return out;
}

struct Wall {
  mesh::TriangleMesh mesh;
  mesh::BoundingBox box;
  bool touches(const Vector3d& p, double radius) const {
    if (((p.array() + radius) < box.min.array()).any() ||
        ((p.array() - radius) > box.max.array()).any())
      return false;
    return mesh::signed_distance(mesh, p) > -radius;
  }
};

}  // namespace

Cleared clear_start(LAMMPS_NS::LAMMPS& lmp, const std::vector<std::string>& meshes, MPI_Comm comm) {
  std::vector<Wall> walls;
  for (const std::string& id : meshes) {
    mesh::TriangleMesh mesh = wall(lmp, id);
    const mesh::BoundingBox box = mesh::bounding_box(mesh);
    walls.push_back({std::move(mesh), box});
  }
  LAMMPS_NS::Atom* atom = lmp.atom;
  const RockNumbers numbers(lmp);
  std::vector<std::uint8_t> goes(numbers.size(), 0);
  for (int i = 0; i < atom->nlocal; ++i) {
    const Vector3d p = Eigen::Map<const Vector3d>(atom->x[i]);
    if (std::any_of(walls.begin(), walls.end(),
                    [&](const Wall& w) { return w.touches(p, atom->radius[i]); }))
      goes[numbers.of_sphere(atom->tag[i])] = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, goes.data(), static_cast<int>(goes.size()), MPI_BYTE, MPI_BOR, comm);
  Cleared cleared;
  cleared.rocks = std::accumulate(goes.begin(), goes.end(), 0.0);
  if (cleared.rocks == 0) return cleared;

  atom->map_clear();
  for (int i = 0; i < atom->nlocal;) {
    const int tag = atom->tag[i];
    const std::size_t rock = numbers.of_sphere(tag);
    if (goes[rock] == 0) {
      ++i;
      continue;
    }
    if (rock == static_cast<std::size_t>(tag)) cleared.mass_kg += atom->rmass[i];
    atom->avec->copy(atom->nlocal - 1, i, 1);
    --atom->nlocal;
  }
  auto* fix = lmp.modify->find_fix_style("multisphere", 0);
  if (auto* bodies = static_cast<LAMMPS_NS::FixMultisphere*>(fix)) {
    auto& data = bodies->data();
    for (int b = 0; b < data.n_body();) {
      if (goes[numbers.of_body(data.tag(b))] == 0) {
        ++b;
        continue;
      }
      cleared.mass_kg += data.mass(b);
      data.remove_body(b);
    }
    data.calc_nbody_all();
  }
  MPI_Allreduce(MPI_IN_PLACE, &cleared.mass_kg, 1, MPI_DOUBLE, MPI_SUM, comm);
  LAMMPS_NS::bigint left = atom->nlocal;
  MPI_Allreduce(&left, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, comm);
  return cleared;
}

ClearStart::ClearStart(LAMMPS_NS::LAMMPS& lmp, std::vector<std::string> meshes)
    : lmp_(lmp), meshes_(std::move(meshes)) {}

std::vector<core::Channel> ClearStart::channels() const {
  return {{"rocks_removed", "1", "-"}, {"mass_removed", "kg", "-"}};
}

void ClearStart::measure(const std::vector<Pose>&, std::vector<double>& parts) const {
  parts.insert(parts.end(), {cleared_.rocks, cleared_.mass_kg});
}

void ClearStart::before_set_up() {
  const Cleared cleared = clear_start(lmp_, meshes_, lmp_.world);
  if (lmp_.comm->me != 0) return;
  cleared_ = cleared;
  if (cleared_.rocks > 0)
    fmt::print("{:.0f} rocks, {:.0f} kg, overlapped a wall at the start and were removed\n",
               cleared_.rocks, cleared_.mass_kg);
}

}  // namespace dipper::dem
