// In place of rock_loop.cpp in `dipper-dem-plain`: LIGGGHTS goes on as it is.
#include "dem/fast/rock_loop.hpp"

namespace dipper::dem {

void speed_up(LAMMPS_NS::LAMMPS&) {}

}  // namespace dipper::dem
