// Rocks from the spheres of a dump: a clump of spheres is one rock with one mass.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "analysis/io/dump_reader.hpp"

namespace dipper::analysis::rock {

struct Fragment {
  std::int64_t key = 0;  ///< a sphere's id, or -1 - id_multisphere: the same rock in every frame
  int type = 1;          ///< size class, from 1
  double mass_kg = 0;
  double density_kg_m3 = 0;                       ///< of solid rock; 0: not known
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< volume-weighted centre of its spheres
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< of that point; zero without velocities
};

/// The masses of clumps: by size class, from a run's deck. Empty for other dumps.
using ClumpMasses = std::map<int, double>;

/// Reads the templates of a deck's rocks.in. Throws InputError naming file and line.
ClumpMasses read_clump_masses(const std::filesystem::path& rocks_in);

/// The source of masses, as in metrics.json: "deck", "mass column" or "spheres".
std::string mass_source(const io::DumpFrame& frame, const ClumpMasses& clumps);

/// Calls `visit` for every rock of a frame: single spheres as they are read, then the clumps; only
/// these are kept in memory. Throws InputError: particles without radius, id, or both mass and
/// density; a clump of a class that the deck does not have.
void for_each_fragment(const io::DumpFrame& frame, const ClumpMasses& clumps,
                       const std::function<void(const Fragment&)>& visit);

}  // namespace dipper::analysis::rock
