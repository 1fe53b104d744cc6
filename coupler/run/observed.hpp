// observed/: a run in the format of a mine's measured folder, without noise.
#pragma once

#include <filesystem>

#include "analysis/observe.hpp"
#include "coupler/case/case.hpp"

namespace dipper {

/// Writes channels.yaml, passes.csv and signals.csv of the run with this record.h5 into `out`
/// (created; files there are replaced). Throws std::runtime_error naming the file.
void write_observed(const std::filesystem::path& record, const ObservationCase& observation,
                    const std::filesystem::path& out);

/// The same from signals at hand.
void write_observed(const DriveSignals& drives, const PassSignals& passes,
                    const ObservationCase& observation, const std::filesystem::path& out);

/// The observation.* lines of a run's case.txt. Throws std::runtime_error naming file and line.
ObservationCase read_observation(const std::filesystem::path& case_txt);

/// Sets one key, such as "observation.lag_s". Throws std::invalid_argument naming key and range.
void set_observation(ObservationCase& observation, const Override& set);

}  // namespace dipper
