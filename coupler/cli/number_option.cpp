#include "coupler/cli/number_option.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "common/numbers.hpp"

namespace dipper::cli {
namespace {

template <class Number>
CLI::Validator in(const Range& range, const char* what) {
  return {[range, what](std::string& text) {
            Number value = 0;
            return parse_number(text, value) && range.holds(static_cast<double>(value))
                       ? std::string()
                       : fmt::format("is '{}'; write a {}, {}", text, what, range.text());
          },
          "NUMBER"};
}

}  // namespace

CLI::Validator number_in(const Range& range) { return in<double>(range, "number"); }

CLI::Validator whole_number_in(const Range& range) {
  return in<std::int64_t>(range, "whole number");
}

}  // namespace dipper::cli
