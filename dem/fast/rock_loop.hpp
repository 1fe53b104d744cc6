// LIGGGHTS's time loop with the parts of it that cost most done here.
#pragma once

#include <verlet.h>

#include "dem/fast/rock_motion.hpp"

namespace dipper::dem {

class NearLists;

/// Puts the loop, the neighbour lists and the contact forces of this folder into LIGGGHTS. Before
/// the deck. What a deck has that they do not know, LIGGGHTS does itself.
void speed_up(LAMMPS_NS::LAMMPS& lmp);

/// LIGGGHTS's velocity Verlet, in the same order and to the same bits, but for the order in which
/// the rock lies in memory, and with it that of sums.
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
  bool own_ = false;                  ///< the deck is one that this loop knows
  LAMMPS_NS::bigint next_order_ = 0;  ///< step from which on the rock is put in order anew
};

}  // namespace dipper::dem
