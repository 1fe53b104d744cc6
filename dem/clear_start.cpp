#include "dem/clear_start.hpp"

#include <abstract_mesh.h>
#include <comm.h>
#include <fix_mesh_surface.h>
#include <fmt/core.h>
#include <lammps.h>
#include <modify.h>
#include <tri_mesh.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "dem/remove_rock.hpp"

namespace dipper::dem {
namespace {

/// Before the first run every rank holds the whole mesh, at its initial pose.
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

}  // namespace

Cleared clear_start(LAMMPS_NS::LAMMPS& lmp, const std::vector<std::string>& meshes) {
  std::vector<mesh::TriangleMesh> walls;
  for (const std::string& id : meshes) walls.push_back(wall(lmp, id));
  return remove_rock(lmp, overlaps(walls));
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
  const Cleared cleared = clear_start(lmp_, meshes_);
  if (lmp_.comm->me != 0) return;
  cleared_ = cleared;
  if (cleared_.rocks > 0)
    fmt::print("{:.0f} rocks, {:.0f} kg, overlapped a wall at the start and were removed\n",
               cleared_.rocks, cleared_.mass_kg);
}

}  // namespace dipper::dem
