// The error for faults in a user's input.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "common/finding.hpp"

namespace dipper {

/// All faults of an input at once; what() has a line for each.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Finding> findings);
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::vector<Finding> findings_;
};

}  // namespace dipper
