// Programs that make a pile: LIGGGHTS, and what puts rock into it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/launch/mpirun.hpp"

namespace dipper::run {

/// What the programs that make a case's pile are started with.
struct PilePrograms {
  const cases::Case& c;
  std::filesystem::path logs;  ///< where LIGGGHTS's output goes
  launch::MpiPlaces places;    ///< of the ranks

  /// A word by which what the case's LIGGGHTS settled is kept: it changes with the order of its
  /// sums.
  std::string settler() const;

  /// Runs dem_in/SCRIPT.in under LIGGGHTS in `folder`, which has PileLinks, to make the file
  /// `makes` there. `variables` are names and values in turn. Throws std::runtime_error with
  /// LIGGGHTS's own message.
  void settle(const std::filesystem::path& folder, const std::string& script, int ranks,
              const std::string& makes, std::vector<std::string> variables) const;

  /// The same with place-rocks, its own words and dem_in/place.in.
  void place(const std::filesystem::path& folder, const std::vector<std::string>& words,
             const std::string& makes, std::vector<std::string> variables) const;

 private:
  void run(const std::filesystem::path& folder, const std::string& name, int ranks,
           std::vector<std::string> command, const std::string& makes,
           std::vector<std::string> variables) const;
};

/// What the scripts name, linked into the folder that LIGGGHTS is started in: neither a script nor
/// the shell it calls reads a path that a user has chosen.
class PileLinks {
 public:
  PileLinks(std::filesystem::path folder, const std::filesystem::path& deck);
  ~PileLinks();
  PileLinks(const PileLinks&) = delete;
  PileLinks& operator=(const PileLinks&) = delete;

 private:
  std::filesystem::path folder_;
};

/// Throws launch::Interrupted once the user has asked to stop.
void heed_interrupts();

}  // namespace dipper::run
