// The motion of the rock in and before the dipper in one frame, and the paper's five stages of
// filling.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/rock/pose_track.hpp"
#include "analysis/rock/rocks.hpp"
#include "common/box.hpp"

namespace dipper::analysis::rock {

/// Rock that moves faster than this relative to the dipper flows, slower rock is bulk [m/s]. The
/// paper says "0 or a very small relative velocity"; this is a tenth of the usual speed of the
/// teeth.
constexpr double kFlowSpeed_m_s = 0.1;

/// The regions in which rock is counted: the load in the dipper in B, the truck's bed in T. Either
/// may be missing.
struct LoadRegions {
  std::optional<Box> dipper;
  std::optional<Box> truck;
  Pose X_WT;
  /// End of the cavity in B; the region of the load extends beyond it, for the heap.
  double lip_x_m = 0;
};

enum class Location { dipper, truck, elsewhere };
Location location_of(const LoadRegions& regions, const Pose& X_WB, const Vector3d& p_W);

/// Sums over the rocks of one frame.
struct FrameSums {
  double rock_kg = 0, in_dipper_kg = 0, in_truck_kg = 0;
  double flow_kg = 0, bulk_kg = 0;  ///< of in_dipper_kg
  double ahead_kg = 0;              ///< before the lip, within half a depth, between the sides
  double relative_momentum = 0;     ///< mass times relative speed in the dipper [kg m/s]
  double kinetic_energy_J = 0;      ///< of the rocks' translation
  double rearmost_m = 0;  ///< distance of the innermost rock in the dipper from the rear [m]

  void add(const Fragment& rock, const LoadRegions& regions, const BodyState& dipper);
  double relative_speed_m_s() const {
    return in_dipper_kg > 0 ? relative_momentum / in_dipper_kg : 0;
  }
};

/// One of the five stages (Rasimarzabadi; the paper, Sec. 4.3 and Fig. 14).
struct Stage {
  int stage = 0;          ///< 1 ... 5
  std::size_t frame = 0;  ///< where it begins
};
const char* stage_name(int stage);

/// The stages of one pass from its frames [begin, end); `leave` is the first frame of breakout.
/// `depth_m` is from lip to rear. Stages that do not occur are left out.
std::vector<Stage> find_stages(const std::vector<FrameSums>& frames, std::size_t begin,
                               std::size_t end, std::size_t leave, double depth_m);

}  // namespace dipper::analysis::rock
