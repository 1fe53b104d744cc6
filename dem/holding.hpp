// Holding rock at rest, as a feature of the rock.
#pragma once

#include <memory>
#include <vector>

#include "coupler/setup/rock_setup.hpp"
#include "dem/hold.hpp"
#include "dem/rock_feature.hpp"
#include "dem/wall_motion.hpp"

namespace dipper::dem {

/// Passes the bodies' positions and motion to HoldRock, and restarts it after a release. Marks the
/// held layer, if the set-up has one, at the run's start. Channel: rock_parked.
class Holding final : public RockFeature {
 public:
  /// \param walls  of the set-up's bodies, in their order; theirs is the extent of a body
  Holding(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup,
          const std::vector<WallMotion*>& walls);

  std::vector<core::Channel> channels() const override { return {{"rock_parked", "kg", "-"}}; }
  void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const override;
  void before_set_up() override;
  void release() override;
  void before_window(const RockWindow& window) override;
  void save(ByteWriter& out) const override;
  void load(ByteReader& in) override;

  /// Wakes all rock but keeps its state, for reading all of it ...
  void wake_all();
  /// ... after which the layer is held again.
  void hold_layer();

  /// Rock that is not in LIGGGHTS, on this rank.
  const std::vector<ParkedRock::Mass>& parked() const;
  const std::vector<ParkedRock::Sphere>& parked_spheres() const;
  long spheres_parked() const { return hold_ ? hold_->spheres_parked() : 0; }

 private:
  void measure_boxes();

  LAMMPS_NS::LAMMPS& lmp_;
  setup::RockSetup setup_;
  std::vector<WallMotion*> walls_;
  std::vector<Box> boxes_;  ///< of the bodies and of the regions weighed with them, once in place
  std::unique_ptr<HoldRock> hold_;
};

}  // namespace dipper::dem
