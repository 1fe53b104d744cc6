#include "common/numbers.hpp"

#include <charconv>
#include <cmath>

namespace dipper {
namespace {

template <class T>
bool parse(std::string_view text, T& value) {
  // from_chars takes a minus but no plus.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T parsed{};
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, parsed);
  if (text.empty() || result.ec != std::errc() || result.ptr != end) return false;
  value = parsed;
  return true;
}

}  // namespace

bool parse_number(std::string_view text, double& value) {
  double parsed = 0;
  if (!parse(text, parsed) || !std::isfinite(parsed)) return false;
  value = parsed;
  return true;
}

bool parse_number(std::string_view text, std::int64_t& value) { return parse(text, value); }

}  // namespace dipper
