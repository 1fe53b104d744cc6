// An estimate of the rock's mass and resistance by soil mechanics, in place of a DEM.
#pragma once

#include "common/box.hpp"
#include "common/height_map.hpp"
#include "coupler/case/case.hpp"
#include "coupler/core/server.hpp"

namespace dipper::dry {

/// Parameters of the estimate.
struct DiggingEstimate {
  bool there_is_rock = true;  ///< false: no mass, no resistance
  double bulk_density_kg_m3 = 0;
  double capacity_kg = 0;             ///< largest load of the dipper
  double specific_resistance_Pa = 0;  ///< of the rock in the dipper's mouth, by cut area
  Vector3d lip_left_B, lip_right_B;   ///< ends of the line of the teeth's tips, m
  Vector3d load_B;                    ///< point at which the load's weight acts, m
};

/// From a case: the rock's density, the dipper; and the specific resistance observed in blasted
/// rock at true size (docs/dry_run.md).
DiggingEstimate digging_estimate(const cases::Case& c);

/// The dipper cuts the bench with the line of its teeth. The cut rock is in the dipper until the
/// door opens. While the dipper moves into rock, the rock resists along the floor, from the teeth
/// to the heel, with the cut area (depth times the dipper's width) times a specific resistance
/// (Dombrovskij's formula; docs/dry_run.md). No rock slides down, none is spilt, no tooth meets a
/// boulder: a mean force for planning a motion, not a result.
///
/// Channels: mass_in_dipper, mass_in_truck, rock_mass, particles and rocks (0) as of the LIGGGHTS
/// side; teeth_x, teeth_y, teeth_z [m], the middle of the teeth's tips in W; cut_depth [m], of the
/// tips below the surface in front of them, perpendicular to it; cut_resistance [N], of the cut.
class EstimatedRock final : public core::LocalRock {
 public:
  /// `timestep_s` is the case's DEM step; windows are counted in it.
  EstimatedRock(HeightMap bench, const DiggingEstimate& estimate, double timestep_s);

  core::ServerInfo info() const override;
  core::RockState place(const std::vector<Pose>& X_WB) override;
  core::RockState step(const core::RockStep& step) override;
  HeightMap look(const HeightGrid& grid) override;
  /// Not supported: a dry run has no checkpoints.
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
