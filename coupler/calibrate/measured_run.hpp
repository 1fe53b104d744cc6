// The runs of a calibration with their measurements, and their table.
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
  std::string stage;  ///< purpose of the run: "case", "search", "confirm"
  std::vector<std::pair<std::string, double>> parameters;  ///< differences from the case
  std::int64_t seed = 0;
  Measures measures;  ///< the first is the calibrated one
  DeckResult result;

  double value() const { return measures.front().second; }
};

/// A run to be made.
struct PlannedRun {
  std::string stage;
  std::vector<std::pair<std::string, double>> parameters;
  DeckRun run;
};

/// Measures a finished run; `run.c` has the changed parameters.
using Measure = std::function<Measures(const DeckRun& run, const std::filesystem::path& dump)>;

/// Makes the runs (run_decks), measures each as it ends and reports it.
std::vector<MeasuredRun> make_runs(const std::vector<PlannedRun>& plan, int jobs,
                                   Reporter& reporter, const Measure& measure);

struct MeanOfSeeds {
  double mean = 0;
  double sigma = 0;          ///< standard deviation of one run
  double sigma_of_mean = 0;  ///< sigma / sqrt(n)
  std::size_t n = 0;
};
MeanOfSeeds mean_of_seeds(const std::vector<MeasuredRun>& runs, const std::string& stage);

/// One row for each run: stage, parameters, seed, measures, CPU seconds, hash. All runs must have
/// the same parameters and measures.
void write_runs_csv(const std::vector<MeasuredRun>& runs, const std::filesystem::path& file);

/// One line `key=value` for each parameter, as --set takes it.
void write_overlay(const std::vector<std::pair<std::string, double>>& parameters,
                   const std::filesystem::path& file);

/// The command line that runs the calibrated case: with the request's settings and these.
std::string run_command(const CalibrationRequest& request,
                        const std::vector<std::pair<std::string, double>>& parameters);

}  // namespace dipper::calibrate
