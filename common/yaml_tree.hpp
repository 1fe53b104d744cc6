// YAML as a plain tree that remembers the line of every key.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/finding.hpp"
#include "common/numbers.hpp"

namespace dipper {

/// A YAML node. A map keeps its keys in the order of the file; none occurs twice.
struct YamlTree {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  std::string scalar;
  bool quoted = false;  ///< "3700" in quotes is text, not a number
  Origin origin;        ///< of the key that holds this node, or of the list element
  std::vector<std::pair<std::string, YamlTree>> children;  ///< of a list, with keys "0", "1", ...

  /// A child by its key; nullptr: no such child.
  YamlTree* find(const std::string& key);
  const YamlTree* find(const std::string& key) const;
};

/// Where text stops being UTF-8; empty: all of it is.
std::optional<std::size_t> first_not_utf8(const std::string& text);

/// Text as a scalar in double quotes, which any text survives unchanged.
std::string in_quotes(const std::string& text);

/// Reads one document. Text that is not UTF-8, syntax errors, keys given twice, anchors and
/// aliases, and further documents are appended to `findings`; the tree is what could be read.
/// `set_key` is the dotted key of a --set whose value this is, "" for a file.
YamlTree parse_yaml(const std::string& text, const std::filesystem::path& file,
                    const std::string& set_key, std::vector<Finding>& findings);

/// Reads a file; a file that cannot be read is a finding, too.
YamlTree read_yaml(const std::filesystem::path& file, std::vector<Finding>& findings);

/// The contents of a node, for messages: "'abc'", "\"12\"" (in quotes), "a list", "a section",
/// "nothing".
std::string shown(const YamlTree& node);

/// The number (common/numbers.hpp) that is a node's whole value, without quotes; empty: not a
/// number.
template <class T>
std::optional<T> number_in(const YamlTree& node) {
  if (node.kind != YamlTree::Kind::scalar || node.quoted) return std::nullopt;
  T value{};
  return parse_number(node.scalar, value) ? std::optional(value) : std::nullopt;
}

}  // namespace dipper
