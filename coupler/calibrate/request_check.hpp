// Checks of a calibration request, before anything starts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/calibrate/calibration.hpp"

namespace dipper::calibrate {

/// The requested case, checked as `dipper run` checks it; reports every finding, or a summary of
/// the case. None when the case or the request has an error.
std::optional<cases::Case> checked_request(const CalibrationRequest& request, Reporter& reporter);

/// The case with other values of some keys and another seed. Throws std::invalid_argument with the
/// first finding of `dipper check`; at the points of a search there is none, since checked_request
/// has checked them.
cases::Case changed_case(const CalibrationRequest& request,
                         const std::vector<std::pair<std::string, double>>& parameters,
                         std::int64_t seed);

/// The value of a numeric key of the case, as in case.txt of a run; none if there is none.
std::optional<double> value_of(const cases::Case& c, const std::string& key);

/// "7 of d200, ..." for classes of which less than one rock is poured; "" if there are none.
std::string missing_classes(const cases::Case& c, const std::vector<double>& rocks);

/// Number of runs at a time.
int jobs_of(const CalibrationRequest& request);

}  // namespace dipper::calibrate
