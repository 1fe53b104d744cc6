// `dipper check CASE [--json]`.
#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::check {

/// Loads and checks a case. Prints one line a finding, `file:line: key: message`, and a last line:
/// "N errors", or "CASE is sound: ..." with what a run of it will take. Returns the exit status:
/// 0 sound, 2 not.
int check_command(const std::filesystem::path& folder,
                  const std::vector<cases::Override>& overrides, std::ostream& out);

/// The same for programs: one JSON object with case, sound, findings[] {file, line, column, key,
/// message} and, of a sound case, case_hash, size {rocks, simulated_s, steps, windows,
/// settle_steps, stable_timestep_s}, values {key: value}, effects {name: strength} and files[] it
/// is made from.
int check_json_command(const std::filesystem::path& folder,
                       const std::vector<cases::Override>& overrides, std::ostream& out);

}  // namespace dipper::check
