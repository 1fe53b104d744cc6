// The exact state of the rock in LIGGGHTS, which a restart file only has with rounding.
#pragma once

#include <filesystem>
#include <functional>

#include "dem/bytes.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Writes a restart file without touching the simulation. The command `write_restart` sends spheres
/// to other ranks first, so that lists and forces must be set up again, and forces
/// differ then: velocity Verlet damps contacts with the velocities of the half step, a set-up
/// with those of the whole one. Contact history in the file is that of the last list build, forces
/// are missing: the image has both. Collective.
void write_restart_untouched(LAMMPS_NS::LAMMPS& lmp, const std::filesystem::path& file);

/// Every sphere and multisphere of this rank in order, with all data of LIGGGHTS's fixes, and the
/// forces. Collective; changes nothing.
void put_rock(LAMMPS_NS::LAMMPS& lmp, ByteWriter& out);

/// Replaces the rock of a restart file by that rock, builds lists and restores the forces. Call
/// between time steps, after set-up. Collective.
void get_rock(LAMMPS_NS::LAMMPS& lmp, ByteReader& in);

/// Writes the output of `put` on all ranks into one file, deflated. Collective.
void write_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp,
                 const std::function<void(ByteWriter&)>& put);

/// This rank's part of it. Collective. Throws std::runtime_error naming the file when it cannot be
/// read or was written by another number of ranks.
ByteReader read_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
