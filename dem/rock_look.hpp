// The rock surface seen from above, from LIGGGHTS's memory.
#pragma once

#include "common/height_map.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

class Holding;

/// The highest sphere over the centre of each cell, of all ranks, parked rock included; 0 where
/// there is none. Collective; does not change the rock.
HeightMap look_at_rock(LAMMPS_NS::LAMMPS& lmp, const Holding* holding, const HeightGrid& grid);

}  // namespace dipper::dem
