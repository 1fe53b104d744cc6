// The rock: LIGGGHTS as a library behind the Rock interface.
#pragma once

#include <mpi.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace dipper {

class WallMotion;

/// A box that rock is weighed in: fixed to a body, or to the world.
struct Scale {
  std::string name;  ///< the channel, in kg
  std::string body;  ///< "" for a fixed box
  Pose X_WS;         ///< the fixed box's frame; unused with a body
  Vector3d min_m, max_m;
};

/// What dipper-dem is started with (written by the launcher as JSON).
struct RockSetup {
  std::string deck;                                            ///< LIGGGHTS input script
  std::vector<std::pair<std::string, std::string>> variables;  ///< -var NAME VALUE
  std::string log;                                             ///< LIGGGHTS log file
  std::string screen;                                          ///< LIGGGHTS screen output
  std::vector<std::string> bodies;                             ///< fix ids of the moving walls
  std::vector<Scale> scales;
  bool resumed = false;  ///< the deck reads a checkpoint: the walls are already in place
  std::int64_t first_step = 0;  ///< DEM steps of the run already taken, at the checkpoint
};

/// Every method is collective: each rank of the communicator makes the same call.
class LiggghtsRock final : public Rock {
 public:
  /// Opens LIGGGHTS and runs the deck. A LIGGGHTS error ends the process, as LIGGGHTS does.
  LiggghtsRock(const RockSetup& setup, MPI_Comm comm);
  ~LiggghtsRock() override;

  ServerInfo info() const override;
  RockState place(const std::vector<Pose>& X_WB) override;
  RockState step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) override;
  void save(const std::filesystem::path& file) override;
  void load(const std::filesystem::path& file) override;
  std::string state_hash() override;

 private:
  void start();
  RockState state();
  std::vector<double> weigh() const;

  RockSetup setup_;
  MPI_Comm comm_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> lmp_;
  std::vector<WallMotion*> walls_;  // owned by LIGGGHTS
  std::vector<Pose> X_WB_;
  std::int64_t first_step_ = 0;
};

}  // namespace dipper
