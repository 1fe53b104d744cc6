// Runs of the calibration decks (dem_in/calibrate_*.in) under the plain LIGGGHTS binary: several at
// a time, one rank each, cached by hash.
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
  /// Of everything that the dump depends on: deck, tables, templates, variables, seed.
  std::string hash;
  bool cached = false;  ///< found in the cache
  double cpu_s = 0;     ///< of the run that made the dump
};

/// Which of the runs are in the cache. Throws as write_deck does.
std::vector<bool> cached_runs(const std::vector<DeckRun>& runs);

/// Runs those that are not in the cache, `jobs` at a time, and reports each as it ends, in any
/// order. Only complete results enter the cache, so two calls may work on the same runs, and
/// results from before an interrupt or a failure are kept. Throws Interrupted after Ctrl-C. When a
/// run fails, no other is started, those in progress are finished, then std::runtime_error names
/// the run and LIGGGHTS's own message.
std::vector<DeckResult> run_decks(
    const std::vector<DeckRun>& runs, int jobs, Reporter& reporter,
    const std::function<void(std::size_t, const DeckResult&)>& finished);

}  // namespace dipper::calibrate
