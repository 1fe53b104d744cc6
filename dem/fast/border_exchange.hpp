// The exchange between ranks, in each step, of rock near their boundary.
#pragma once

#include <initializer_list>
#include <vector>

namespace LAMMPS_NS {
class FixMultisphere;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// LIGGGHTS passes every sphere near a boundary three times a step: back to its rank and on to the
/// others once it has moved, and its force to the rank of its body; one neighbour after the other,
/// each waiting for the one before. Here a sphere goes only where it is needed, to all neighbours
/// at once: back if its body is on another rank, on if it moves, its force if its body is
/// on another rank. The result is the same to the bit.
class BorderExchange {
 public:
  explicit BorderExchange(LAMMPS_NS::LAMMPS& lmp) : lmp_(lmp) {}

  /// Once lists are built, and when rock has come to rest or wakes. Collective. Returns false, and
  /// no other method may be called, if a sphere may have to pass through a rank to reach another
  /// (ranks in more than one row, or ones thinner than a rock reaches).
  bool renew(LAMMPS_NS::FixMultisphere& bodies);

  void return_moved_spheres();  ///< of this rank's bodies, to the ranks whose spheres they are
  void return_velocities();     ///< of the same alone
  void forward_moved_spheres();
  void forward_forces();  ///< to the ranks of the spheres' bodies

 private:
  /// Indices of spheres. Those of `out` are this rank's and ghosts on rank `to`; `in` the reverse.
  struct Swap {
    int to, from;
    std::vector<int> moving_out, moving_in;
    std::vector<int> of_body_out, of_body_in;  ///< whose body is where they are ghosts
  };
  enum class Way { forward, home };

  void pass(Way way, std::vector<int> Swap::*out, std::vector<int> Swap::*in,
            std::initializer_list<double**> vectors);

  LAMMPS_NS::LAMMPS& lmp_;
  std::vector<Swap> swaps_;
  std::vector<std::vector<double>> sent_, received_;
};

}  // namespace dipper::dem
