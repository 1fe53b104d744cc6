// YAML as a plain tree that remembers the line of every key: what the case loader walks.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// A YAML node. A map keeps its keys in the order of the file; none occurs twice.
struct YamlTree {
  enum class Kind { empty, scalar, list, map };
  Kind kind = Kind::empty;
  std::string scalar;
  bool quoted = false;  ///< "3700" in quotes is text, not a number
  Origin origin;        ///< of the key that holds this node, or of the list element
  std::vector<std::pair<std::string, YamlTree>> children;  ///< of a list, with keys "0", "1", ...

  YamlTree* find(const std::string& key);
};

/// Reads one document. Syntax errors, keys given twice, anchors and aliases, and further documents
/// are appended to `findings`; the tree is what could be read. `set_key` is the dotted key of a
/// --set whose value this is, "" for a file.
YamlTree parse_yaml(const std::string& text, const std::filesystem::path& file,
                    const std::string& set_key, std::vector<Finding>& findings);

}  // namespace dipper::cases
