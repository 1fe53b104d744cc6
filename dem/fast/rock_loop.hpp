// LIGGGHTS's time loop with faster versions of its most expensive parts.
#pragma once

#include <verlet.h>

#include "dem/fast/rock_motion.hpp"

namespace dipper::dem {

class NearLists;

/// Puts the loop, the neighbour lists and the contact forces of this folder into LIGGGHTS. Call
/// before the deck. For features of a deck that they do not support, LIGGGHTS's own are used.
void speed_up(LAMMPS_NS::LAMMPS& lmp);

/// LIGGGHTS's velocity Verlet, in the same order and to the same bits, except for the order of the
/// rock in memory, and so of sums.
class RockLoop final : public LAMMPS_NS::Verlet {
 public:
  RockLoop(LAMMPS_NS::LAMMPS* l, NearLists& lists);
  void init() override;
  void run(int n) override;

 private:
  void renew_lists();

  LAMMPS_NS::LAMMPS& lmp_;
  NearLists& lists_;
  RockMotion motion_;
  bool own_ = false;                  ///< this loop supports the deck
  LAMMPS_NS::bigint next_order_ = 0;  ///< step from which the rock is sorted again
};

}  // namespace dipper::dem
