// Rock that is not there: what it would weigh and how it would resist, by soil mechanics.
#pragma once

#include "common/box.hpp"
#include "common/height_map.hpp"
#include "coupler/case/case.hpp"
#include "coupler/core/server.hpp"

namespace dipper::dry {

/// What the estimate rests on.
struct DiggingEstimate {
  bool there_is_rock = true;  ///< false: nothing weighs, nothing resists
  double bulk_density_kg_m3 = 0;
  double capacity_kg = 0;             ///< the dipper takes no more
  double specific_resistance_Pa = 0;  ///< of the rock to the mouth, by area of the cut
  Vector3d lip_left_B, lip_right_B;   ///< ends of the line of the teeth's tips, m
  Vector3d load_B;                    ///< where the load's weight acts, m
};

/// Of a case: its rock's density, its dipper; and the specific resistance that blasted rock at true
/// size has shown (docs/dry_run.md).
DiggingEstimate digging_estimate(const cases::Case& c);

/// The dipper cuts the bench with the line of its teeth. What it cuts lies in it from then on,
/// until the door opens; and while it goes into rock, the rock resists along the floor, from the
/// teeth to the heel, by the cut's area, its depth by the dipper's width, times a specific
/// resistance (Dombrovskij's formula; docs/dry_run.md). Nothing comes down from above, nothing is
/// spilt, no tooth meets a boulder: a mean force to design a path with, not a result.
///
/// Channels: mass_in_dipper, mass_in_truck, rock_mass, particles and rocks (0) as LIGGGHTS's side
/// has them; teeth_x, teeth_y, teeth_z [m], the middle of the teeth's tips in W; cut_depth [m], of
/// it under the surface in front of it, square to that; cut_resistance [N], of the wedge.
class EstimatedRock final : public core::LocalRock {
 public:
  /// `timestep_s` is the case's: a window has so many of them.
  EstimatedRock(HeightMap bench, const DiggingEstimate& estimate, double timestep_s);

  core::ServerInfo info() const override;
  core::RockState place(const std::vector<Pose>& X_WB) override;
  core::RockState step(const core::RockStep& step) override;
  HeightMap look(const HeightGrid& grid) override;
  /// There is nothing to go on from.
  void save(const std::filesystem::path&) override {}
  std::string state_hash() override { return ""; }

 private:
  core::RockState state() const;
  Wrench dig(const Pose& from, const core::RockStep& step);

  HeightMap bench_;
  DiggingEstimate estimate_;
  Vector3d tip_B_;
  double timestep_s_;
  std::vector<Pose> X_WB_;
  Wrench load_;
  std::int64_t step_ = 0;
  double in_dipper_kg_ = 0, in_truck_kg_ = 0, depth_m_ = 0, resistance_N_ = 0;
};

}  // namespace dipper::dry
