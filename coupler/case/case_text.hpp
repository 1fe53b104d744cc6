// The canonical text of a case: what is recorded, compared and hashed.
#pragma once

#include <functional>
#include <string>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Formats a path of the case.
using PathText = std::function<std::string(const std::filesystem::path&)>;

/// One line `key=value` a key, in order of the keys; numbers with 17 digits. Each line is a --set
/// that sets the same value, so the text is also a recipe. Deterministic: the same case gives the
/// same bytes on every machine and in every locale. By default paths are relative to the case
/// folder.
std::string case_text(const Case& c, const PathText& path_text = nullptr);

}  // namespace dipper::cases
