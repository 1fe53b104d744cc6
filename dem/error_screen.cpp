#include "dem/error_screen.hpp"

#include <comm.h>
#include <lammps.h>

#include <cstdio>

namespace dipper::dem {

void show_errors_of_all_ranks(LAMMPS_NS::LAMMPS& lammps) {
  // Not stderr: Error::all closes any screen but stdout.
  if (lammps.comm->me != 0) lammps.screen = stdout;
  if (lammps.screen == nullptr) return;
  std::fflush(lammps.screen);
  std::setvbuf(lammps.screen, nullptr, _IOLBF, 0);
}

}  // namespace dipper::dem
