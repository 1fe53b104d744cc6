// runaway SETUP.json: moves the set-up's bodies out of the box. runaway_test.cpp starts it.
#include <mpi.h>

#include <fstream>

#include "dem/liggghts_rock.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc != 2) return 2;
  std::ifstream in(argv[1]);
  const dipper::setup::RockSetup setup = dipper::setup::rock_setup_from(nlohmann::json::parse(in));
  dipper::dem::LiggghtsRock rock(setup, MPI_COMM_WORLD);
  std::vector<dipper::Pose> X_WB(setup.bodies.size());
  for (auto& X : X_WB) X.p.z() = 8;
  rock.place(X_WB);
  for (int k = 0; k < 1000; ++k) {
    for (auto& X : X_WB) X.p.x() += 0.1;
    rock.step({10, X_WB});
  }
  MPI_Finalize();  // not reached: 100 m on, there is no box
  return 0;
}
