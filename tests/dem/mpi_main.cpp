// main of the tests that run LIGGGHTS: every rank runs every test, rank 0 speaks, and the program
// fails if any rank does.
#include <gtest/gtest.h>
#include <mpi.h>

#include "tests/one_file.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  dipper::test::start_tests(argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (rank != 0) delete listeners.Release(listeners.default_result_printer());
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
