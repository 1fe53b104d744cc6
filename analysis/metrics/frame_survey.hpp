// One pass over all frames: sums of each, and where the rock of each load goes.
#pragma once

#include <unordered_map>

#include "analysis/run/run_folder.hpp"

namespace dipper::analysis::metrics {

/// The frames of one pass between which its load is followed.
struct LoadToFollow {
  std::size_t lift_frame = 0;   ///< the load is the rock in the dipper in this frame
  std::size_t end_frame = 0;    ///< the frame in which it is located again
  std::size_t start_frame = 0;  ///< of the pass
};

struct LoadFate {
  double lifted_kg = 0;
  double truck_kg = 0, carry_back_kg = 0, back_in_pile_kg = 0, spillage_kg = 0;  ///< sum: the load
  double truck_from_elsewhere_kg = 0;  ///< gained by the truck from other rock
  std::map<int, double> class_kg;      ///< lifted, by class
};

/// The rectangle the rock covers in a frame, seen from above.
struct Footprint {
  Eigen::Vector2d min = Eigen::Vector2d::Constant(1e300), max = Eigen::Vector2d::Constant(-1e300);
  void add(const Vector3d& p_W);
  bool holds(const Vector3d& p_W) const;
};

/// Mass and size of one class of rock.
struct ClassSums {
  double mass_kg = 0, volume_m3 = 0;
  std::size_t rocks = 0;
};

struct Survey {
  std::vector<rock::FrameSums> frames;
  std::vector<LoadFate> fates;         ///< one for each load, in order
  std::map<int, ClassSums> classes;    ///< of all rock in the first frame
  Footprint pile;                      ///< of the rock on the ground in the first frame
  std::size_t rocks = 0, spheres = 0;  ///< in the last frame
};

/// Reads every frame once. A rock of a load that is missing in the end frame has left the domain
/// and counts as spilt. `dipper` may be empty.
Survey survey_frames(const io::DumpFolder& dumps, const rock::ClumpMasses& clumps,
                     const rock::LoadRegions& regions, const rock::PoseTrack& dipper,
                     const std::vector<LoadToFollow>& loads);

}  // namespace dipper::analysis::metrics
