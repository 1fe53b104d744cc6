// The value of a scalar in a YamlTree, and how a message shows a node that holds another.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

#include "coupler/case/yaml_tree.hpp"

namespace dipper::cases {

/// "'abc'", "\"12\"" (in quotes), "a list", "a section", "nothing".
inline std::string shown(const YamlTree& node) {
  switch (node.kind) {
    case YamlTree::Kind::empty:
      return "nothing";
    case YamlTree::Kind::list:
      return "a list";
    case YamlTree::Kind::map:
      return "a section";
    case YamlTree::Kind::scalar:
      break;
  }
  return node.quoted ? "\"" + node.scalar + "\"" : "'" + node.scalar + "'";
}

/// Stricter than yaml-cpp, which reads hexadecimal, nan and .inf: decimal digits to the last
/// character, and finite. Empty when the node holds anything else.
template <class T>
std::optional<T> parse_number(const YamlTree& node) {
  if (node.kind != YamlTree::Kind::scalar || node.quoted) return std::nullopt;
  const char* first = node.scalar.data();
  const char* last = first + node.scalar.size();
  if (last - first > 1 && *first == '+' && first[1] != '-') ++first;
  T value{};
  const auto result = std::from_chars(first, last, value);
  if (result.ec != std::errc{} || result.ptr != last) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) {
    if (!std::isfinite(value)) return std::nullopt;
  }
  return value;
}

}  // namespace dipper::cases
