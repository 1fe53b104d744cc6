#include "dem/time_loop.hpp"

#include <input.h>
#include <integrate.h>
#include <lammps.h>
#include <output.h>
#include <update.h>

#include <algorithm>
#include <limits>

namespace dipper::dem {

void set_up_time_loop(LAMMPS_NS::LAMMPS& lmp) {
  lmp.input->one("run 0 post no");
  LAMMPS_NS::Update* update = lmp.update;
  update->whichflag = 1;
  update->firststep = update->beginstep = update->ntimestep;
  update->laststep = update->endstep = update->ntimestep + std::numeric_limits<int>::max();
  lmp.output->init();
  lmp.output->setup(0);
}

void keep_frames(LAMMPS_NS::LAMMPS& lmp) {
  LAMMPS_NS::Output& output = *lmp.output;
  std::fill_n(output.last_dump, output.ndump, lmp.update->ntimestep);
}

void run_steps(LAMMPS_NS::LAMMPS& lmp, std::int64_t n) {
  lmp.update->nsteps = static_cast<int>(n);
  lmp.update->integrate->run(static_cast<int>(n));
}

}  // namespace dipper::dem
