#include "common/input_error.hpp"

#include <fmt/format.h>

namespace dipper {

InputError::InputError(std::vector<std::string> messages)
    : std::runtime_error(fmt::format("{}", fmt::join(messages, "\n"))),
      messages_(std::move(messages)) {}

}  // namespace dipper
