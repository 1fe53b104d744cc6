// A file the user wrote is wrong.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace dipper {

/// Everything wrong with one input file, a message each; what() joins them with newlines.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages);
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

}  // namespace dipper
