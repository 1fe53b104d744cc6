// Rock that is added at a given step.
#pragma once

#include <vector>

#include "coupler/setup/rock_setup.hpp"
#include "dem/rock_feature.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Before the window of that step it runs the deck that adds the rock; after it, it throws
/// std::runtime_error when less than 80 % of the rock could be placed. LIGGGHTS checks new rock for
/// overlap with all rock, so none may be parked.
class Collapse final : public RockFeature {
 public:
  Collapse(LAMMPS_NS::LAMMPS& lmp, setup::RockFall fall);

  bool needs_all_rock(const RockWindow& window) const override;
  void before_window(const RockWindow& window) override;
  void after_window(const RockWindow& window) override;

 private:
  LAMMPS_NS::LAMMPS& lmp_;
  setup::RockFall fall_;
  double mass_before_kg_ = 0;
};

}  // namespace dipper::dem
