// A file the user wrote is wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "common/finding.hpp"

namespace dipper {

/// Everything wrong with an input at once; what() has a line for each fault.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Finding> findings);
  const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::vector<Finding> findings_;
};

}  // namespace dipper
