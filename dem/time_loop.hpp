// LIGGGHTS's time loop, entered directly.
#pragma once

#include <cstdint>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Sets up lists and forces and makes the time loop ready for run_steps. `run N` of a deck would
/// zero the walls' velocity and print a block of output each time. The last step is set
/// to the largest number, so that dump and thermo output keep their intervals across windows.
/// Collective.
void set_up_time_loop(LAMMPS_NS::LAMMPS& lmp);

/// Keeps the frames of the present step: set_up_time_loop writes none. For a resumed run, whose
/// frames are there, and whose rock is not all in LIGGGHTS yet.
void keep_frames(LAMMPS_NS::LAMMPS& lmp);

/// Runs n steps. Collective.
void run_steps(LAMMPS_NS::LAMMPS& lmp, std::int64_t n);

}  // namespace dipper::dem
