// The size distribution of a settled pile, and the case's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::result {

/// One size class. The pour draws whole rocks, and cutting the bench to its profile loses some.
struct AchievedClass {
  std::string name;
  double size_m = 0;  ///< as dug: coarse-grained
  std::size_t rocks = 0;
  double mass_percent = 0;    ///< of the rock in the pile
  double wanted_percent = 0;  ///< of the case
};

/// Counts a frame of LIGGGHTS's particles (columns type, id_multisphere): a sphere is a rock, and
/// so are the spheres of one multisphere. `dumps` is a run's folder; its first frame is the settled
/// pile. Throws InputError naming the file.
std::vector<AchievedClass> achieved_grading(const cases::Case& c,
                                            const std::filesystem::path& dumps);

/// class,size_m,rocks,mass_percent,wanted_percent
std::string to_csv(const std::vector<AchievedClass>& classes);

}  // namespace dipper::result
