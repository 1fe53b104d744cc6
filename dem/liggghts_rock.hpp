// The rock: LIGGGHTS as a library behind the Rock interface.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "dem/rock_feature.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

class Holding;
class WallMotion;

/// Runs windows of LIGGGHTS's time loop, moves the walls, and calls the rock's features
/// (rock_feature.hpp) in this order: weighing, holding, crust, collapse, clearing of the start,
/// pauses of the bodies' contact.
/// A window is: features before it, targets of the walls, steps, features after it, walls' loads
/// and the features' channels. Every method is collective: each rank of the communicator makes the
/// same call.
class LiggghtsRock final : public core::LocalRock {
 public:
  /// Opens LIGGGHTS and runs the deck. A LIGGGHTS error ends the process, as LIGGGHTS does.
  LiggghtsRock(const setup::RockSetup& setup, MPI_Comm comm);
  ~LiggghtsRock() override;

  core::ServerInfo info() const override;
  core::RockState place(const std::vector<Pose>& X_WB) override;
  /// Throws std::runtime_error for a pause of contact that the set-up does not allow.
  core::RockState step(const core::RockStep& step) override;
  /// Writes a restart file of LIGGGHTS, and beside it its image (setup::image_of), which a resumed
  /// run also needs. Does not change the run: a run that saves and one that does not are
  /// bit-identical.
  void save(const std::filesystem::path& file) override;
  HeightMap look(const HeightGrid& grid) override;
  std::string state_hash() override;

  /// LIGGGHTS itself: the tests read its meshes, contacts and momenta.
  LAMMPS_NS::LAMMPS& liggghts() { return *lmp_; }

 private:
  core::RockState state();
  void resume_from(const std::filesystem::path& image);

  setup::RockSetup setup_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp_;
  std::vector<WallMotion*> walls_;  // owned by LIGGGHTS
  std::vector<Pose> X_WB_;
  std::vector<std::unique_ptr<RockFeature>> features_;
  Holding* holding_ = nullptr;  // one of the features, or null
};

}  // namespace dipper::dem
