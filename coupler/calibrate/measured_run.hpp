// The runs of a calibration and what was measured on each: the table it leaves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/calibrate/calibration.hpp"
#include "coupler/calibrate/deck_runs.hpp"

namespace dipper::calibrate {

using Measures = std::vector<std::pair<std::string, double>>;  ///< column name, value; in order

struct MeasuredRun {
  std::string stage;  ///< what the run was for: "case", "search", "confirm"
  std::vector<std::pair<std::string, double>> parameters;  ///< what differs from the case
  std::int64_t seed = 0;
  Measures measures;  ///< the first is the calibrated one
  DeckResult result;

  double value() const { return measures.front().second; }
};

/// A run that is to be made.
struct PlannedRun {
  std::string stage;
  std::vector<std::pair<std::string, double>> parameters;
  DeckRun run;
};

/// How a finished run is measured; the parameters have changed `run.c` already.
using Measure = std::function<Measures(const DeckRun& run, const std::filesystem::path& dump)>;

/// Makes the runs (run_decks), measures each as it ends and tells of it.
std::vector<MeasuredRun> make_runs(const std::vector<PlannedRun>& plan, int jobs,
                                   Reporter& reporter, const Measure& measure);

struct MeanOfSeeds {
  double mean = 0;
  double sigma = 0;          ///< standard deviation of one run
  double sigma_of_mean = 0;  ///< sigma / sqrt(n)
  std::size_t n = 0;
};
MeanOfSeeds mean_of_seeds(const std::vector<MeasuredRun>& runs, const std::string& stage);

/// One row a run: stage, parameters, seed, measures, CPU seconds, hash. All runs have the same
/// parameters and measures.
void write_runs_csv(const std::vector<MeasuredRun>& runs, const std::filesystem::path& file);

/// One line `key=value` a parameter, as --set takes it.
void write_overlay(const std::vector<std::pair<std::string, double>>& parameters,
                   const std::filesystem::path& file);

/// The command line of a run of the case as it was calibrated: with the request's settings and
/// these.
std::string run_command(const CalibrationRequest& request,
                        const std::vector<std::pair<std::string, double>>& parameters);

}  // namespace dipper::calibrate
