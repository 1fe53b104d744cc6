// Whether a text begins with another: std::string_view::starts_with of C++20.
#pragma once

#include <string_view>

namespace dipper {

inline bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

}  // namespace dipper
