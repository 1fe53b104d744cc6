#include "common/warn.hpp"

#include <fmt/core.h>

#include <cstdio>

namespace dipper {

void warn(const std::string& message) { fmt::print(stderr, "dipper: {}\n", message); }

}  // namespace dipper
