#include "coupler/cli/gap_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/installation.hpp"

namespace dipper::cli {
namespace {

// Debian's, which scripts/setup gives the packages; another python3 on the path may not have them.
constexpr const char* kPython = "/usr/bin/python3";

}  // namespace

int gap_command(const std::vector<std::string>& words) {
  setenv("PYTHONPATH", (data_folder() / "analysis/gap").c_str(), 1);
  setenv("DIPPER", installed_program("dipper").c_str(), 1);
  // The runs fill the cores by themselves; threads in the linear algebra would only be in their
  // way.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  std::vector<std::string> all = {kPython, "-B", "-m", "dipper_gap"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> argv;
  for (std::string& word : all) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(kPython, argv.data());
  throw std::runtime_error(fmt::format("cannot start {}: {}", kPython, std::strerror(errno)));
}

}  // namespace dipper::cli
