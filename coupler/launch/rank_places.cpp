#include "coupler/launch/rank_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "common/host_identity.hpp"
#include "common/input_error.hpp"
#include "common/installation.hpp"
#include "common/text_file.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/launch/mpi_scratch.hpp"
#include "coupler/launch/process.hpp"
#include "coupler/launch/shell_words.hpp"

namespace dipper::launch {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds kPatience{120};  // ssh may take long to give up a host

[[noreturn]] void refuse(const std::string& why) { throw InputError({{{}, 0, "--mpirun", why}}); }

bool is_one_of(const std::string& option, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return option == "--" + word || option == "-" + word;
  });
}

bool names_hostfile(const std::string& option) {
  return is_one_of(option, {"hostfile", "machinefile", "default-hostfile"});
}

/// mpirun's options for hosts; each takes one argument.
bool names_hosts(const std::string& option) {
  return names_hostfile(option) || is_one_of(option, {"host", "H"});
}

/// Whether a batch system gave this job more than one host.
bool hosts_are_allocated() {
  const auto more_than_one = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && std::atoi(value) > 1;
  };
  return more_than_one("SLURM_JOB_NUM_NODES") || more_than_one("NHOSTS");  // Slurm, Grid Engine
}

/// mpirun's error: the first paragraph between its rules, or a line.
std::string complaint(const std::string& said) {
  std::istringstream in(said);
  std::string found;
  bool boxed = false;
  for (std::string line; std::getline(in, line);) {
    const bool rule = line.rfind("---", 0) == 0;
    if (rule && !boxed) {
      boxed = true;
      found.clear();
      continue;
    }
    const auto begin = line.find_first_not_of(' ');
    if (rule || begin == std::string::npos) {
      if (boxed && !found.empty()) break;
      continue;
    }
    if (boxed || found.empty()) found += (found.empty() ? "" : " ") + line.substr(begin);
  }
  return found.empty() ? "mpirun ended without a message" : found;
}

/// "h1 (2 ranks), h2 (1 rank)", in the order of ranks.
std::string list_hosts(const std::vector<RankPlace>& ranks) {
  std::vector<RankPlace> hosts;
  std::string text;
  for (const RankPlace& rank : ranks) {
    const auto same = [&](const RankPlace& other) { return other.network == rank.network; };
    if (std::any_of(hosts.begin(), hosts.end(), same)) continue;
    hosts.push_back(rank);
    const auto here = std::count_if(ranks.begin(), ranks.end(), same);
    text += fmt::format("{}{} ({} rank{})", text.empty() ? "" : ", ", rank.host, here,
                        here == 1 ? "" : "s");
  }
  return text;
}

/// The places that all ranks report.
std::vector<RankPlace> ask_ranks(int ranks, const MpiPlaces& places, const std::string& program) {
  const fs::path log = mpi_scratch() / "hosts.log";
  fs::remove(log);
  Process process(mpirun(ranks, {program, "--hosts"}, places), log);
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!process.wait(std::chrono::milliseconds(50))) {
    if (interrupts() > 0) throw Interrupted();
    if (std::chrono::steady_clock::now() > deadline)
      refuse(
          fmt::format("mpirun did not bring {} ranks together in {} s", ranks, kPatience.count()));
  }
  const std::string said = read_bytes(log).value_or("");
  const std::vector<RankPlace> found = read_places(said, ranks);
  if (process.succeeded() && !found.empty()) return found;
  const std::string fault = mpirun_fault();
  if (!fault.empty()) refuse(fault);
  const bool alone = said.rfind("rank\t0", 0) == 0;  // each process is rank 0 of a run of its own
  refuse(alone ? fmt::format("not {} ranks came up: {} is of another MPI than this program, which "
                             "takes Open MPI's; put that one's folder first in PATH",
                             ranks, found_on_path("mpirun"))
               : complaint(said));
}

}  // namespace

std::vector<std::string> mpirun_options(const std::string& text) {
  std::vector<std::string> options = shell_words(text, "--mpirun");
  for (std::size_t k = 0; k + 1 < options.size(); ++k) {
    if (!names_hostfile(options[k])) continue;
    std::string& file = options[k + 1];
    file = fs::absolute(file).string();  // mpirun is started in the run's folder
    if (!std::ifstream(file) || fs::is_directory(file))
      refuse(file +
             ": cannot be read; a file with one line per host, as `mpirun --hostfile` takes it");
  }
  return options;
}

std::vector<RankPlace> read_places(const std::string& said, int ranks) {
  std::vector<RankPlace> found(static_cast<std::size_t>(ranks));
  std::istringstream in(said);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::string what, number, host, network;
    for (std::string* cell : {&what, &number, &host, &network}) std::getline(cells, *cell, '\t');
    const long rank = std::strtol(number.c_str(), nullptr, 10);
    if (what != "rank" || network.empty() || rank < 0 || rank >= ranks) continue;
    found[static_cast<std::size_t>(rank)] = {host, network};
  }
  const bool all = std::none_of(found.begin(), found.end(),
                                [](const RankPlace& rank) { return rank.network.empty(); });
  return all ? found : std::vector<RankPlace>{};
}

std::vector<std::string> without_hosts(const std::vector<std::string>& options) {
  std::vector<std::string> kept;
  for (std::size_t k = 0; k < options.size(); ++k) {
    if (names_hosts(options[k])) {
      ++k;
    } else {
      kept.push_back(options[k]);
    }
  }
  return kept;
}

PlacedRanks place_ranks(int ranks, const std::vector<std::string>& options,
                        const std::string& program) {
  PlacedRanks placed{{options, false, 1}, ""};
  const bool hosts =
      hosts_are_allocated() || std::any_of(options.begin(), options.end(), names_hosts);
  if (options.empty() && (!hosts || ranks == 1)) return placed;
  placed.places.several_hosts = hosts;
  const std::vector<RankPlace> found = ask_ranks(ranks, placed.places, program);
  const std::string here = network_identity();
  placed.hosts = list_hosts(found);
  if (found.front().network != here)
    refuse(
        fmt::format("rank 0 is on {}, but must be on this host, {}, beside the launcher and the "
                    "machine side; name this host first",
                    found.front().host, host_name()));
  const auto count = std::count_if(found.begin(), found.end(),
                                   [&](const RankPlace& rank) { return rank.network == here; });
  placed.places.several_hosts = count < ranks;
  placed.places.part_here = static_cast<double>(count) / ranks;
  if (!placed.places.several_hosts) placed.places.options = without_hosts(options);
  return placed;
}

}  // namespace dipper::launch
