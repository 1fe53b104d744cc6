#include "dem/fast/close_pairs.hpp"

#include <atom.h>
#include <neigh_list.h>

#include <algorithm>

namespace dipper::dem {

const std::vector<ClosePair>& ClosePairs::now(const LAMMPS_NS::Atom& atom,
                                              const LAMMPS_NS::NeighList& list,
                                              const LAMMPS_NS::NeighList& contacts, double reach,
                                              bool renewed, int resting) {
  if (!renewed && !moved(atom, 0.5 * reach)) return pairs_;
  const double *x = atom.x[0], *radius = atom.radius;
  x_.assign(x, x + 3 * static_cast<std::ptrdiff_t>(atom.nlocal + atom.nghost));
  pairs_.clear();
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k], count = list.numneigh[i];
    const int *const near = list.firstneigh[i], *const touched = contacts.firstneigh[i];
    const bool rests = (atom.mask[i] & resting) != 0;
    const double xi[3] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]}, ri = radius[i];
    for (int n = 0; n < count; ++n) {
      const int j = near[n];
      if (rests && (atom.mask[j] & resting) != 0) continue;
      const double dx = xi[0] - x[3 * j], dy = xi[1] - x[3 * j + 1], dz = xi[2] - x[3 * j + 2];
      const double most = ri + radius[j] + reach;
      if (dx * dx + dy * dy + dz * dz < most * most || touched[n] != 0) pairs_.push_back({i, j, n});
    }
  }
  return pairs_;
}

bool ClosePairs::moved(const LAMMPS_NS::Atom& atom, double most) const {
  const int all = atom.nlocal + atom.nghost;
  if (x_.size() != 3 * static_cast<std::size_t>(all)) return true;
  const double* x = atom.x[0];
  double farthest = 0;
  for (int i = 0; i < 3 * all; i += 3) {
    const double dx = x[i] - x_[i], dy = x[i + 1] - x_[i + 1], dz = x[i + 2] - x_[i + 2];
    farthest = std::max(farthest, dx * dx + dy * dy + dz * dz);
  }
  return farthest > most * most;
}

}  // namespace dipper::dem
