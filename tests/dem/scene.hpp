// What the tests of the LIGGGHTS adapter start from: a folder, box meshes, a deck's set-up.
#pragma once

#include <mpi.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "coupler/setup/rock_setup.hpp"
#include "tests/common/mesh/shapes.hpp"
#include "tests/places.hpp"

namespace dipper::test {

inline int rank() {
  int r = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

/// A fresh folder that all ranks share and that goes when the scene goes. Collective.
class Scene {
 public:
  explicit Scene(const std::string& name) {
    int pid = getpid();  // rank 0's: tests that run at once may share a name
    MPI_Bcast(&pid, 1, MPI_INT, 0, MPI_COMM_WORLD);
    folder_ =
        std::filesystem::temp_directory_path() / ("dipper_dem_" + name + "_" + std::to_string(pid));
    if (rank() == 0) {
      std::filesystem::remove_all(folder_);
      std::filesystem::create_directories(folder_);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Scene() {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0) std::filesystem::remove_all(folder_);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// Writes NAME.stl, a mesh in the body frame; returns its path.
  std::string stl(const std::string& name, const mesh::TriangleMesh& mesh) const {
    const auto file = folder_ / (name + ".stl");
    if (rank() == 0) std::ofstream(file) << test::ascii_stl(mesh);
    MPI_Barrier(MPI_COMM_WORLD);
    return file.string();
  }

  /// A deck of this folder, standing still; its log and screen go to the scene's folder.
  setup::RockSetup setup(const std::string& deck) const {
    setup::RockSetup s;
    s.deck = (test::dem_tests() / deck).string();
    s.log = (folder_ / "log.liggghts").string();
    s.screen = (folder_ / "screen.liggghts").string();
    s.variables = {{"folder", test::dem_tests().string()}, {"run_steps", "0"}};
    return s;
  }

  /// bed.in: rock of a kind poured onto a floor, and a paddle, a cube of 0.6 m.
  setup::RockSetup bed(const std::string& kind) const {
    setup::RockSetup s = setup("bed.in");
    s.bodies = {"paddle"};
    s.variables.push_back({"rock", kind});
    s.variables.push_back({"floor", stl("floor", box({-1.5, -1.5, -0.3}, {1.5, 1.5, 0}))});
    s.variables.push_back({"paddle", stl("paddle", box({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}))});
    return s;
  }

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// Much of a bed rests soon, and is woken by the paddle.
inline setup::HoldSettings lively_hold() {
  setup::HoldSettings hold;
  hold.below_m_s = 1;
  hold.rest_s = 0.05;
  hold.margin_m = 0.2;
  hold.layer_m = 0.1;
  hold.gather_s = 0.02;
  return hold;
}

}  // namespace dipper::test
