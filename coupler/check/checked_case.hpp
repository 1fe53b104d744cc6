// A case that may be run, or its faults.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"

namespace dipper::check {

/// Loads a case, chooses its step where it says `auto`, and checks it. Sound when
/// `findings`, empty before, still is.
cases::Case read_case(const std::filesystem::path& folder,
                      const std::vector<cases::Override>& overrides,
                      std::vector<Finding>& findings);

/// Reads a case and reports a line per finding, `file:line: key: message`, and "N errors"; or
/// "CASE is sound: ..." with the cost of a run, and "warning: " and a line for every warning
/// (warnings.hpp). Returns the case when it is sound.
std::optional<cases::Case> checked_case(const std::filesystem::path& folder,
                                        const std::vector<cases::Override>& overrides,
                                        Reporter& reporter);

/// The same for programs: one JSON object with case, sound, findings[] {file, line, column, key,
/// message} and, of a sound case, warnings[] like them, case_hash, size {rocks, simulated_s, steps,
/// windows, settle_steps, stable_timestep_s}, cost (cost_estimate.hpp), values {key: value},
/// effects {name: strength} and files[] it is made from; and the program's source_hash, as given.
/// Whether it is sound.
bool check_as_json(const std::filesystem::path& folder,
                   const std::vector<cases::Override>& overrides, const std::string& source_hash,
                   Reporter& reporter);

}  // namespace dipper::check
