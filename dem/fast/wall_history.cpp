// Replaces two functions of LIGGGHTS: for contacts of walls and rock, only rock near a wall is
// checked.
//
// For each mesh and in each step LIGGGHTS marks the contacts of every sphere and then searches all
// of them for ended ones, though few are near a wall. These definitions override the library's,
// because the dynamic linker searches the program first; the sums are the same.
// When the lists are not this folder's (speed_up was not called), they call the library's.
#include "dem/fast/wall_history.hpp"

#include <atom.h>
#include <dlfcn.h>
#include <error.h>
#include <fix_contact_history_mesh.h>
#include <fix_property_atom.h>
#include <neighbor.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "dem/fast/near_lists.hpp"

namespace dipper::dem {
namespace {

/// For each mesh's history, the spheres in its lists.
std::unordered_map<const LAMMPS_NS::Fix*, std::vector<int>> near_walls;

bool is_fast(const LAMMPS_NS::Neighbor* lists) {
  return dynamic_cast<const NearLists*>(lists) != nullptr;
}

using Member = void (*)(LAMMPS_NS::FixContactHistoryMesh*);

/// LIGGGHTS's function, by its symbol, which a definition here hides.
Member in_library(const char* symbol) {
  void* const found = dlsym(RTLD_NEXT, symbol);
  if (found == nullptr) throw std::runtime_error(std::string("LIGGGHTS has no ") + symbol);
  return reinterpret_cast<Member>(found);
}

}  // namespace

void use_wall_history() { near_walls.clear(); }

}  // namespace dipper::dem

namespace LAMMPS_NS {

void FixContactHistoryMesh::markAllContacts() {
  if (!dipper::dem::is_fast(neighbor)) {
    static const auto of_library =
        dipper::dem::in_library("_ZN9LAMMPS_NS21FixContactHistoryMesh15markAllContactsEv");
    return of_library(this);
  }
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
  if (!dipper::dem::is_fast(neighbor)) {
    static const auto of_library =
        dipper::dem::in_library("_ZN9LAMMPS_NS21FixContactHistoryMesh15cleanUpContactsEv");
    return of_library(this);
  }
  for (const int i : dipper::dem::near_walls[this]) cleanUpContacts(i, i + 1);
}

}  // namespace LAMMPS_NS
