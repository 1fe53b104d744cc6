#include "coupler/cli/python_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/installation.hpp"

namespace dipper::cli {
namespace {

// Debian's, which scripts/setup gives the packages; another python3 on the path may not have them.
constexpr const char* kPython = "/usr/bin/python3";
// Each holds one package.
constexpr std::array kFolders = {"analysis/gap", "analysis/logs", "analysis/runs",
                                 "analysis/study"};

}  // namespace

int python_command(const std::string& package, const std::vector<std::string>& words) {
  std::string path;
  for (const char* folder : kFolders)
    path += (path.empty() ? "" : ":") + (data_folder() / folder).string();
  setenv("PYTHONPATH", path.c_str(), 1);
  // Neither the current folder's modules nor a user's own packages: a csv.py there would be run. By
  // the environment, so that the programs this one starts do the same.
  setenv("PYTHONSAFEPATH", "1", 1);
  setenv("PYTHONNOUSERSITE", "1", 1);
  unsetenv("PYTHONHOME");
  setenv("DIPPER", installed_program("dipper").c_str(), 1);
  // The runs fill the cores by themselves; threads in the linear algebra would only be in their
  // way.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  std::vector<std::string> all = {kPython, "-B", "-m", package};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(kPython, argv.data());
  throw std::runtime_error(fmt::format("cannot start {}: {}", kPython, std::strerror(errno)));
}

}  // namespace dipper::cli
