// LIGGGHTS's neighbour lists, built faster.
#pragma once

#include <neighbor.h>

#include <utility>
#include <vector>

namespace dipper::dem {

/// The same pairs as LIGGGHTS's `neighbor bin` lists, in another order. LIGGGHTS's bins are as wide
/// as the largest rock is, so in rock of mixed sizes most spheres that it tests are out of reach.
/// Here spheres are binned by size (each level holds radii within a factor of kStep of each other,
/// in bins as wide as two of them reach), and a bin's spheres are contiguous.
class NearLists final : public LAMMPS_NS::Neighbor {
 public:
  explicit NearLists(LAMMPS_NS::LAMMPS* l) : Neighbor(l) {}

  /// In this step no sphere has moved by more than this [m]. A step without a call checks itself.
  void moved(double most) {
    moved_ += kSlack * most;
    known_ = true;
  }

  void build(int topology = 1) override;
  int check_distance() override;

 protected:
  void choose_build(int list, LAMMPS_NS::NeighRequest* request) override;

 private:
  static constexpr double kStep = 1.5;
  static constexpr double kSlack = 1.02;  // a turning body's spheres move on arcs
  static constexpr double kFar = 1e300;

  struct Near {
    double x, y, z, radius;
    int index;
  };
  struct Level {
    double largest_m = 0;  ///< radius
    double lo[3] = {0, 0, 0}, per_m = 0;
    int n[3] = {0, 0, 0};
    std::vector<int> first;  ///< sphere of each bin; x runs fastest
    std::vector<Near> spheres;
    int bin(int axis, double x) const;
  };

  void fill_levels();
  /// Every pair within reach once, below the sphere of lower index.
  void find_pairs();
  void build_near(LAMMPS_NS::NeighList* list);
  double farthest() const;

  std::vector<Level> levels_;
  std::vector<std::pair<int, int>> pairs_;  ///< as found
  std::vector<std::size_t> first_pair_;     ///< in near_, of each sphere of this rank
  std::vector<int> near_;                   ///< the other sphere of each pair
  double moved_ = 0;                        ///< at most, since lists were built [m]
  bool known_ = false;
};

}  // namespace dipper::dem
