#pragma once

#include <vector>

namespace LAMMPS_NS {
class Atom;
class NeighList;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// Spheres i and j, the n-th in i's list.
struct ClosePair {
  int i, j, n;
};

/// Of the pairs of a neighbour list those that may touch before a sphere has moved far: most pairs
/// of a list are apart by a part of its skin, and stay so for many steps.
class ClosePairs {
 public:
  /// In the list's order. `reach`: a gap [m] within which pairs are kept; they are searched again
  /// once a sphere has moved half of it, and when `renewed`, as the list is. Pairs of two spheres
  /// with the mask bit `resting` are left out.
  const std::vector<ClosePair>& now(const LAMMPS_NS::Atom& atom, const LAMMPS_NS::NeighList& list,
                                    const LAMMPS_NS::NeighList& contacts, double reach,
                                    bool renewed, int resting);

 private:
  bool moved(const LAMMPS_NS::Atom& atom, double most) const;

  std::vector<double> x_;  ///< of all spheres, ghosts too, when the pairs were searched
  std::vector<ClosePair> pairs_;
};

}  // namespace dipper::dem
