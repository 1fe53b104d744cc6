#include "coupler/cli/environment.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "common/cache_folder.hpp"
#include "common/input_error.hpp"
#include "common/installation.hpp"

namespace dipper::cli {
namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Variables that an MPI launcher sets for its ranks begin so. A user's own, OMPI_MCA_..., stay.
constexpr std::array kLauncherWords = {"OMPI_UNIVERSE_SIZE",
                                       "OMPI_COMM_WORLD_",
                                       "OMPI_APP_CTX_",
                                       "OMPI_FIRST_RANKS",
                                       "OMPI_NUM_APP_CTX",
                                       "OMPI_FILE_LOCATION",
                                       "OMPI_COMMAND",
                                       "OMPI_ARGV",
                                       "OMPI_MCA_ess",
                                       "OMPI_MCA_orte_",
                                       "OMPI_MCA_pmix",
                                       "PMIX_",
                                       "PMI_",
                                       "MPI_LOCAL"};

/// Runs start their own ranks; the variables of an mpirun that started this process would prevent
/// that. Several ranks of it would all be the same run, in one folder.
void leave_mpirun() {
  for (const char* size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const std::string ranks = variable(size); !ranks.empty() && ranks != "1")
      throw InputError({{"", 0, "",
                         "an mpirun has started " + ranks +
                             " of this program, which would all do the same; start one, without "
                             "mpirun, and say --ranks " +
                             ranks}});
  for (const char* word : kLauncherWords) unset_variables(word);
}

}  // namespace

void unset_variables(const std::string& start) {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (std::strncmp(*entry, start.c_str(), start.size()) == 0)
      names.emplace_back(*entry, std::strcspn(*entry, "="));
  for (const std::string& name : names) unsetenv(name.c_str());
}

void read_environment() {
  leave_mpirun();
  const std::filesystem::path cache = variable("XDG_CACHE_HOME"), home = variable("HOME");
  if (!cache.empty()) {
    set_cache_folder(std::filesystem::absolute(cache) / "dipper");  // the two sides start elsewhere
  } else if (!home.empty()) {
    set_cache_folder(home / ".cache" / "dipper");
  }
  if (const std::filesystem::path data = variable("DIPPER_DATA"); !data.empty())
    set_data_folder(data);
}

}  // namespace dipper::cli
