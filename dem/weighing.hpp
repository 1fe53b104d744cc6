// Weighs the rock: in each box that the set-up names, and all of it.
#pragma once

#include <string>
#include <vector>

#include "coupler/setup/rock_setup.hpp"
#include "dem/rock_feature.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

class Holding;

/// Channels: the boxes' masses, rock_mass, rock_kinetic_energy, rocks (multispheres), particles
/// (spheres, those of the rocks included). Parked rock is included.
class Weighing final : public RockFeature {
 public:
  /// \param holding  may have parked rock; null: no rock is parked
  Weighing(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup, const Holding* holding);

  std::vector<core::Channel> channels() const override;
  void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const override;

 private:
  LAMMPS_NS::LAMMPS& lmp_;
  const Holding* holding_;
  std::vector<setup::Scale> scales_;
  std::vector<std::size_t>
      body_;  ///< of each scale: its place in X_WB; past the end for a fixed box
};

/// Mass of all rock in LIGGGHTS on all ranks [kg]; not of parked rock. Collective.
double rock_mass(LAMMPS_NS::LAMMPS& lmp);

}  // namespace dipper::dem
