// The programs that make a pile: LIGGGHTS and place-rocks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/launch/mpirun.hpp"

namespace dipper::run {

/// How the programs that make a case's pile are started.
struct PilePrograms {
  const cases::Case& c;
  std::filesystem::path logs;  ///< folder of LIGGGHTS's output
  launch::MpiPlaces places;    ///< hosts of the ranks
  Reporter& reporter;          ///< is shown how far LIGGGHTS is

  /// Identifies the LIGGGHTS that settled a pile, in cache keys: its version and the time loop,
  /// which fixes the order of summation.
  std::string settler() const;

  /// Runs dem_in/SCRIPT.in under LIGGGHTS in `folder`, which has PileLinks, to make the file
  /// `makes` there. `variables`: name, value, name, value ... Throws std::runtime_error with
  /// LIGGGHTS's own message.
  void settle(const std::filesystem::path& folder, const std::string& script, int ranks,
              const std::string& makes, std::vector<std::string> variables) const;

  /// The same with place-rocks, its arguments and dem_in/place.in.
  void place(const std::filesystem::path& folder, const std::vector<std::string>& words,
             const std::string& makes, std::vector<std::string> variables) const;

 private:
  void run(const std::filesystem::path& folder, const std::string& name, int ranks,
           std::vector<std::string> command, const std::string& makes,
           std::vector<std::string> variables) const;
};

/// Links to the files that the scripts name, in the folder in which LIGGGHTS runs: so no script and
/// no shell command contains a path that the user chose.
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
