#include "dem/work_folder.hpp"

namespace dipper::dem {
namespace fs = std::filesystem;

setup::RockSetup enter_work_folder(setup::RockSetup setup, const fs::path& folder, MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  if (rank == 0) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::create_symlink(fs::path(setup.deck).parent_path(), folder / "dem_in");
  }
  for (auto& [name, value] : setup.variables) {
    const fs::path path = value;
    if (!path.is_absolute()) continue;
    value = name;
    if (rank == 0) fs::create_symlink(path, folder / name);
  }
  MPI_Barrier(comm);
  fs::current_path(folder);
  return setup;
}

}  // namespace dipper::dem
