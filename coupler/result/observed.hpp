// observed/: a run in the format of a mine's measured folder, without noise.
#pragma once

#include <filesystem>

#include "analysis/signals/observe.hpp"
#include "coupler/case/case.hpp"

namespace dipper::result {

/// Writes channels.yaml, passes.csv and signals.csv of the run with this record.h5 into `out`
/// (created; files there are replaced), and profile.csv where the run has faces. Throws
/// std::runtime_error naming the file.
void write_observed(const std::filesystem::path& record, const cases::ObservationCase& observation,
                    const std::filesystem::path& out);

/// The same from signals in memory, with machine and faces of the run's folder.
void write_observed(const analysis::signals::DriveSignals& drives,
                    const analysis::signals::PassSignals& passes,
                    const cases::ObservationCase& observation, const std::filesystem::path& run,
                    const std::filesystem::path& out);

/// Throws InputError for a folder with files that these would replace and did not write: a mine's.
void require_no_measured(const std::filesystem::path& out);

/// Throws InputError where the rate gives less than two readings of the run with this record.h5.
void require_readings(const std::filesystem::path& record, double rate_Hz);

/// The observation.* lines of a run's case.txt. Throws std::runtime_error naming file and line.
cases::ObservationCase read_observation(const std::filesystem::path& case_txt);

/// Sets one key, such as "observation.lag_s". Throws std::invalid_argument naming key and range.
void set_observation(cases::ObservationCase& observation, const cases::Override& set);

}  // namespace dipper::result
