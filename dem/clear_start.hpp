// Removes rock at the machine's initial position before the first step.
#pragma once

#include <string>
#include <vector>

#include "dem/remove_rock.hpp"
#include "dem/rock_feature.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

/// Removes every rock with a sphere that overlaps one of the closed wall meshes or lies inside its
/// steel: it would be thrown out. (Svanberg et al. 2021, section 3.2: rocks in the space of the
/// bucket were moved or removed, since the pile is made when there is no shovel.) Rock that is free
/// in the dipper's hollow stays. Call after the deck and before the first run. Collective.
/// Throws std::runtime_error when the deck has no such mesh.
Cleared clear_start(LAMMPS_NS::LAMMPS& lmp, const std::vector<std::string>& meshes);

/// The feature that does so. Channels: rocks_removed, mass_removed; 0 in the rows after a resume.
class ClearStart final : public RockFeature {
 public:
  ClearStart(LAMMPS_NS::LAMMPS& lmp, std::vector<std::string> meshes);

  std::vector<core::Channel> channels() const override;
  void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const override;
  void before_set_up() override;

 private:
  LAMMPS_NS::LAMMPS& lmp_;
  std::vector<std::string> meshes_;
  Cleared cleared_;  ///< on rank 0 alone, since the record gets sums
};

}  // namespace dipper::dem
