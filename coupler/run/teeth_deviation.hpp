// How far the teeth are from where they were sent.
#pragma once

#include <filesystem>

#include "analysis/signals/phases.hpp"
#include "common/record/columns.hpp"
#include "coupler/case/case.hpp"
#include "machine/kinematics.hpp"

namespace dipper::run {

/// A record's teeth against where taut ropes that do not stretch would have them.
class TeethDeviation {
 public:
  /// Throws std::runtime_error naming file and dataset.
  TeethDeviation(const std::filesystem::path& record, const cases::Case& c);

  /// The largest distance in a phase [m]: some centimetres under load; more where the dipper rides
  /// on rock.
  double most(const analysis::signals::Phase& phase) const;

 private:
  machine::ShovelKinematics taut_;
  record::Columns columns_;
};

}  // namespace dipper::run
