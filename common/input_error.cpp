#include "common/input_error.hpp"

namespace dipper {
namespace {

std::string lines(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) text += (text.empty() ? "" : "\n") + to_string(f);
  return text;
}

}  // namespace

InputError::InputError(std::vector<Finding> findings)
    : std::runtime_error(lines(findings)), findings_(std::move(findings)) {}

}  // namespace dipper
