// The rock in LIGGGHTS, to the bit: what a restart file of LIGGGHTS lacks.
#pragma once

#include <filesystem>
#include <functional>

#include "dem/bytes.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Writes a restart file without touching the simulation. The command `write_restart` sends spheres
/// to other ranks first, so that lists and forces must be set up again, and forces come out
/// different then: velocity Verlet damps contacts with the velocities of the half step, a set-up
/// with those of the whole one. Contact history in the file is that of the last list build, forces
/// are not in it: the image has both. Collective.
void write_restart_untouched(LAMMPS_NS::LAMMPS& lmp, const std::filesystem::path& file);

/// Every sphere and multisphere of this rank in its order, with all that LIGGGHTS's fixes keep of
/// it, and the forces it goes on with. Collective, and changes nothing.
void put_rock(LAMMPS_NS::LAMMPS& lmp, ByteWriter& out);

/// Puts that rock in place of what a restart file gave, builds lists and gives each the forces it
/// had. Between time steps, once set up. Collective.
void get_rock(LAMMPS_NS::LAMMPS& lmp, ByteReader& in);

/// One file with what `put` writes on each rank, deflated. Collective.
void write_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp,
                 const std::function<void(ByteWriter&)>& put);

/// This rank's part of it. Collective. Throws std::runtime_error naming the file when it cannot be
/// read or was written by another number of ranks.
ByteReader read_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
