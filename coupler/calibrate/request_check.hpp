// What is wrong with a request, before anything starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/calibrate/calibration.hpp"

namespace dipper::calibrate {

/// The case as asked for, checked as `dipper run` checks it; tells every finding, or what the case
/// is. Nothing when something is wrong with it, or with the request.
std::optional<cases::Case> checked_request(const CalibrationRequest& request, Reporter& reporter);

/// The case with other values of some keys and another seed. Throws std::invalid_argument with the
/// first finding of `dipper check`; none at the points of a search, which checked_request has seen.
cases::Case changed_case(const CalibrationRequest& request,
                         const std::vector<std::pair<std::string, double>>& parameters,
                         std::int64_t seed);

/// A number of the case by its key, as it stands in case.txt of a run; nothing when there is none.
std::optional<double> value_of(const cases::Case& c, const std::string& key);

/// "7 of d200, ..." when a class has less than one rock among those poured; "" when all have.
std::string missing_classes(const cases::Case& c, const std::vector<double>& rocks);

/// How many runs at once.
int jobs_of(const CalibrationRequest& request);

}  // namespace dipper::calibrate
