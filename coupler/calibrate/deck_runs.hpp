// Runs of the calibration decks (dem_in/calibrate_*.in) under the plain LIGGGHTS binary: several at
// once, each one rank, kept by hash.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"

namespace dipper::calibrate {

/// One run of a deck with a case's rock and contact.
struct DeckRun {
  std::string deck;  ///< "calibrate_pile": dem_in/calibrate_pile.in
  std::string dump;  ///< the file it writes into ${out}
  cases::Case c;
  std::vector<std::pair<std::string, std::string>> variables;  ///< -var NAME VALUE
};

struct DeckResult {
  std::filesystem::path dump;
  std::string hash;     ///< of all that decides the dump: deck, tables, templates, variables, seed
  bool cached = false;  ///< it was there already
  double cpu_s = 0;     ///< what the run took when it was made
};

/// Which of the runs are in the cache already. Throws as write_deck does.
std::vector<bool> cached_runs(const std::vector<DeckRun>& runs);

/// Runs what is not in the cache, `jobs` at a time, and tells of each as it ends, in any order.
/// A result enters the cache whole or not at all, so two calls may work on the same runs, and what
/// was finished before an interrupt or a failure is kept. Throws Interrupted after Ctrl-C; when a
/// run fails, no other is begun, those at work are finished, then std::runtime_error names the run
/// and LIGGGHTS's own message.
std::vector<DeckResult> run_decks(
    const std::vector<DeckRun>& runs, int jobs, Reporter& reporter,
    const std::function<void(std::size_t, const DeckResult&)>& finished);

}  // namespace dipper::calibrate
