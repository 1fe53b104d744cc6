// summary.json of a run.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "common/reporter.hpp"
#include "coupler/case/case.hpp"
#include "coupler/result/run_cost.hpp"
#include "coupler/result/run_folder.hpp"

namespace dipper::result {

/// The contents of summary.json that are neither in the case nor in record.h5.
struct RunFacts {
  std::string status;   ///< "complete", "interrupted" or "failed"
  std::string failure;  ///< with "failed": side, time, message
  std::int64_t syncs = 0, dem_steps = 0;
  double interface_work_J = 0, energy_residual_J = 0;
  RunCost cost;
  std::string state_hash;
  std::string operator_command;  ///< of the program that drove the machine; "": none did
};

/// Writes the keys of docs/results.md for a run whose record is closed, and deck/achieved.csv.
/// Passes come from the record, the rock from the dumps; both are reported. Throws
/// std::runtime_error naming the file that cannot be read or written.
void write_summary(const cases::Case& c, const RunFolder& folder, const RunFacts& facts,
                   Reporter& reporter);

/// The "status" of a summary; "" when there is none.
std::string summary_status(const std::filesystem::path& summary);

}  // namespace dipper::result
