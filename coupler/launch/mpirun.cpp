#include "coupler/launch/mpirun.hpp"

#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

#include "common/installation.hpp"
#include "common/text_file.hpp"
#include "coupler/launch/mpi_scratch.hpp"
#include "coupler/launch/process.hpp"

namespace dipper::launch {
namespace {

/// mpirun's command before the program, with each parameter once.
class Command {
 public:
  explicit Command(const std::vector<std::string>& options) : options_(options) {}

  /// Adds "--word value", unless the user gave that option, with one dash or two.
  void add(const std::string& word, const std::string& value) {
    if (!says(word)) words.insert(words.end(), {"--" + word, value});
  }
  void add_parameter(const std::string& name, const std::string& value) {
    for (std::size_t k = 0; k + 1 < options_.size(); ++k)
      if ((options_[k] == "--mca" || options_[k] == "-mca") && options_[k + 1] == name) return;
    words.insert(words.end(), {"--mca", name, value});
  }
  bool says(const std::string& word) const {
    return std::any_of(options_.begin(), options_.end(), [&](const std::string& option) {
      return option == "--" + word || option == "-" + word;
    });
  }

  std::vector<std::string> words = {"mpirun"};

 private:
  const std::vector<std::string>& options_;
};

/// Whether one process may read another's memory, as ranks do to pass messages on. Containers may
/// refuse it, and Open MPI then says so for every message.
bool may_read_memory() {
  char from = 1, to = 0;
  const iovec there{&from, 1}, here{&to, 1};
  return process_vm_readv(getpid(), &here, 1, &there, 1, 0) == 1;
}

void keep_here(Command& command, int ranks) {
  if (!command.says("nooversubscribe")) command.words.push_back("--oversubscribe");
  // Two ranks unbound tend to stay on one core. A single rank is left to the scheduler, so that two
  // runs of one rank share a machine.
  command.add("bind-to", ranks > 1 ? "core:overload-allowed" : "none");
  // A rank that yields while it waits gives a whole time slice (3 ms) to any other work on its
  // core, thousands of times per second: ranks yield only where they share cores.
  command.add_parameter(
      "mpi_yield_when_idle",
      static_cast<unsigned>(ranks) > std::thread::hardware_concurrency() ? "1" : "0");
  command.add_parameter("btl", "self,vader");
  if (!may_read_memory()) command.add_parameter("btl_vader_single_copy_mechanism", "none");
  command.add_parameter("plm", "isolated");
  command.add_parameter("ras", "^slurm,gridengine");
  for (const char* where : {"orte_tmpdir_base", "btl_vader_backing_directory"})
    command.add_parameter(where, mpi_scratch().string());
}

void go_abroad(Command& command) {
  // With these, in s, mpirun notices a network failure; its defaults are 300, 20, 9.
  command.add_parameter("oob_tcp_keepalive_time", "10");
  command.add_parameter("oob_tcp_keepalive_intvl", "5");
  command.add_parameter("oob_tcp_keepalive_probes", "3");
}

}  // namespace

std::vector<std::string> mpirun(int ranks, std::vector<std::string> program,
                                const MpiPlaces& places) {
  Command command(places.options);
  places.several_hosts ? go_abroad(command) : keep_here(command, ranks);
  std::vector<std::string>& words = command.words;
  if (geteuid() == 0 && !command.says("allow-run-as-root")) words.push_back("--allow-run-as-root");
  words.insert(words.end(), places.options.begin(), places.options.end());
  words.insert(words.end(), {"-np", std::to_string(ranks)});
  words.insert(words.end(), program.begin(), program.end());
  return words;
}

std::string mpirun_fault() {
  const std::string place = found_on_path("mpirun");
  if (place == "mpirun")
    return "no mpirun on PATH; install Open MPI (openmpi-bin), or put its folder into PATH";
  const std::filesystem::path answer = mpi_scratch() / "version.log";
  std::filesystem::remove(answer);
  Process process({place, "--version"}, answer);
  process.wait(std::chrono::seconds(5));
  process.end();
  const std::string said = read_bytes(answer).value_or("");
  if (said.find("Open MPI") != std::string::npos || said.find("OpenRTE") != std::string::npos)
    return "";
  return place +
         " is not Open MPI's, which this program takes; put that one's folder first in PATH";
}

}  // namespace dipper::launch
