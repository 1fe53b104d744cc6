// The value of a scalar in a YamlTree, and how a message shows a node that holds another.
#pragma once

#include <optional>
#include <string>

#include "common/numbers.hpp"
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

/// Stricter than yaml-cpp, which reads hexadecimal, nan and .inf. Empty when the node holds no
/// number of common/numbers.hpp.
template <class T>
std::optional<T> parse_number(const YamlTree& node) {
  if (node.kind != YamlTree::Kind::scalar || node.quoted) return std::nullopt;
  T value{};
  return dipper::parse_number(node.scalar, value) ? std::optional(value) : std::nullopt;
}

}  // namespace dipper::cases
