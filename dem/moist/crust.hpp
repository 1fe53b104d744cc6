// Bonds the rock of a crust.
#pragma once

#include <lammps.h>

#include "coupler/setup/rock_setup.hpp"
#include "dem/rock_feature.hpp"

namespace dipper::dem {

/// Makes every contact of two spheres in the zone a bond of the cohesion model `moist`. After a
/// set-up (`run 0`) and before another, which computes the forces again. Collective over the ranks.
/// Throws std::runtime_error if the deck has no property/atom crust_zone.
void form_crust(LAMMPS_NS::LAMMPS& lmp, const setup::CrustZone& zone);

/// Unbroken bonds of this rank; one to a rock of another rank counts half on each.
double count_bonds(const LAMMPS_NS::LAMMPS& lmp);

/// Bonds the zone at the run's start. Channel: bonds, the unbroken ones.
class Crust final : public RockFeature {
 public:
  Crust(LAMMPS_NS::LAMMPS& lmp, const setup::CrustZone& zone) : lmp_(lmp), zone_(zone) {}

  std::vector<core::Channel> channels() const override { return {{"bonds", "1", "-"}}; }
  void measure(const std::vector<Pose>&, std::vector<double>& parts) const override {
    parts.push_back(count_bonds(lmp_));
  }
  bool after_set_up() override {
    form_crust(lmp_, zone_);
    return true;
  }

 private:
  LAMMPS_NS::LAMMPS& lmp_;
  setup::CrustZone zone_;
};

}  // namespace dipper::dem
