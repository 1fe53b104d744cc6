// The rock seen from above, straight from LIGGGHTS's memory.
#pragma once

#include "common/height_map.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

class Holding;

/// The highest sphere over each cell's middle, of all ranks, parked rock included; 0 where there is
/// none. Collective; changes nothing.
HeightMap look_at_rock(LAMMPS_NS::LAMMPS& lmp, const Holding* holding, const HeightGrid& grid);

}  // namespace dipper::dem
