#include "dem/rank_count.hpp"

#include <fmt/core.h>
#include <mpi.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>

namespace dipper::dem {
namespace {

std::string on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = (std::filesystem::path(folder) / program).string();
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return program;
}

}  // namespace

void check_rank_count(int asked) {
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == asked) return;
  throw std::runtime_error(fmt::format(
      "{} rank{} came up where {} belong: {} is of another MPI than this program, which "
      "takes Open MPI's; put that one's folder first in PATH",
      ranks, ranks == 1 ? "" : "s", asked, on_path("mpirun")));
}

}  // namespace dipper::dem
