// dipper calibrate: the request and the two calibrations.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"

namespace dipper::calibrate {

/// A key to search and its range.
struct SearchRange {
  std::string key;
  double low = 0, high = 0;
};

struct CalibrationRequest {
  std::filesystem::path case_folder;
  std::vector<cases::Override> overrides;  ///< --set and --seed
  std::vector<SearchRange> search;         ///< pile-angle only; empty: measure the unchanged case
  double size_m = 0;          ///< lift of the sheet, or edge of the box; 0: from the rocks' size
  double target = 0;          ///< deg or kg/m3; 0: the paper's, or the case's
  double sigma = 1;           ///< of the target, deg
  int seeds = 0;              ///< at each point of the search, or of the measurement; 0: default
  int jobs = 0;               ///< runs at a time; 0: one for each core
  std::filesystem::path out;  ///< folder of the result; must not exist
};

/// The mean of the six waste rock piles of the paper's Table 4.
inline constexpr double kPaperPileAngle_deg = 34.7;

/// Exit status: 0 done; 2 the request or the case is wrong, nothing started. Throws Interrupted and
/// std::runtime_error as run_decks does. Both write runs.csv, calibration.json and, when a change
/// of the case meets the target, calibrated.set into `out`.
int calibrate_pile_angle(const CalibrationRequest& request, Reporter& reporter);
int calibrate_bulk_density(const CalibrationRequest& request, Reporter& reporter);

}  // namespace dipper::calibrate
