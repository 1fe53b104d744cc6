// No contact between dipper and rock during the return to the face.
#pragma once

#include <vector>

#include "coupler/setup/rock_setup.hpp"
#include "dem/remove_rock.hpp"
#include "dem/rock_feature.hpp"

namespace LAMMPS_NS {
class LAMMPS;
class FixWallGran;
}  // namespace LAMMPS_NS

namespace dipper::dem {

class WallMotion;

/// Removes the bodies' walls from the wall contact in windows without contact (Svanberg et al.
/// 2021, section 3.3: "The contact was deactivated when the rope shovel was moving back to the dig
/// position") and puts them back. Rock that is in their steel by then is removed, as at a run's
/// start. So is, if the set-up says so, the rock on the floor in front of the face, which a dozer
/// removes in a mine. Both masses are recorded.
///
/// Channels, summed over the run so far: cleared_overlap and cleared_floor, kg.
class ContactPause final : public RockFeature {
 public:
  /// \param walls  of the bodies; the deck's `fix walls` has their meshes as its last. Throws
  ///   std::runtime_error otherwise.
  ContactPause(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup,
               const std::vector<WallMotion*>& walls);

  std::vector<core::Channel> channels() const override;
  void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const override;
  bool needs_all_rock(const RockWindow& window) const override;
  void before_window(const RockWindow& window) override;
  void save(ByteWriter& out) const override;
  void load(ByteReader& in) override;

 private:
  void let_touch(bool touch);
  void clear();

  LAMMPS_NS::LAMMPS& lmp_;
  std::optional<setup::FloorStrip> floor_;
  std::vector<WallMotion*> walls_;
  LAMMPS_NS::FixWallGran* contact_ = nullptr;
  int meshes_ = 0;  ///< of the wall contact, the bodies' included
  bool touches_ = true;
  double overlap_kg_ = 0, floor_kg_ = 0;
};

}  // namespace dipper::dem
