// In place of two functions of LIGGGHTS's: between walls and rock, only rock near a wall is looked
// at.
//
// For each mesh and in each step LIGGGHTS marks the contacts of every sphere and then looks at
// every one again for those that have ended, though few have a wall near. These definitions stand
// before the library's, as the dynamic linker looks in the program first; without them the sums are
// the same.
#include "dem/fast/wall_history.hpp"

#include <atom.h>
#include <error.h>
#include <fix_contact_history_mesh.h>
#include <fix_property_atom.h>
#include <neighbor.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace dipper::dem {
namespace {

/// Of each mesh's history, the spheres that its lists name.
std::unordered_map<const LAMMPS_NS::Fix*, std::vector<int>> near_walls;

}  // namespace

void use_wall_history() { near_walls.clear(); }

}  // namespace dipper::dem

namespace LAMMPS_NS {

void FixContactHistoryMesh::markAllContacts() {
  std::vector<int>& near = dipper::dem::near_walls[this];
  if (neighbor->ago > 0) {
    for (const int i : near) std::fill_n(keepflag_[i], nneighs(i), false);
    return;
  }
  near.clear();
  keeppage_[0]->reset(true);
  intersectpage_[0]->reset(false);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int n = nneighs(i);
    if (n > 0) near.push_back(i);
    keepflag_[i] = keeppage_[0]->get(n);
    intersectflag_[i] = intersectpage_[0]->get(n);
    if (keepflag_[i] == nullptr || intersectflag_[i] == nullptr)
      error->one(FLERR, "mesh contact history overflow, boost neigh_modify one");
  }
}

void FixContactHistoryMesh::cleanUpContacts() {
  for (const int i : dipper::dem::near_walls[this]) cleanUpContacts(i, i + 1);
}

}  // namespace LAMMPS_NS
