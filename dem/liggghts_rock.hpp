// The rock: LIGGGHTS as a library behind the Rock interface.
#pragma once

#include <mpi.h>

#include <memory>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"
#include "dem/clear_start.hpp"
#include "dem/rock_setup.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper::dem {

class HoldRock;
class WallMotion;

/// Every method is collective: each rank of the communicator makes the same call.
class LiggghtsRock final : public core::Rock {
 public:
  /// Opens LIGGGHTS and runs the deck. A LIGGGHTS error ends the process, as LIGGGHTS does.
  LiggghtsRock(const RockSetup& setup, MPI_Comm comm);
  ~LiggghtsRock() override;

  core::ServerInfo info() const override;
  core::RockState place(const std::vector<Pose>& X_WB) override;
  core::RockState step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;
  std::string state_hash() override;

  /// LIGGGHTS itself, for what no method gives: the tests read its meshes, contacts and momenta.
  LAMMPS_NS::LAMMPS& liggghts() { return *lmp_; }

 private:
  void start();
  core::RockState state();
  std::vector<double> weigh() const;
  void hold(std::int64_t n_steps, const std::vector<Pose>& X_WB_target);
  bool rock_falls(std::int64_t n_steps) const;
  void let_rock_in();
  void check_rock_came(double mass_before_kg) const;
  double rock_mass() const;

  RockSetup setup_;
  MPI_Comm comm_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp_;
  std::vector<WallMotion*> walls_;  // owned by LIGGGHTS
  std::vector<Pose> X_WB_;
  Cleared cleared_;  // nothing in a run that is resumed
  std::unique_ptr<HoldRock> hold_;
};

}  // namespace dipper::dem
