// The keys of a case before they are values: those of its file, of what it includes, of --set.
#pragma once

#include <filesystem>
#include <vector>

#include "common/yaml_tree.hpp"
#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Merges the included file and the overrides into the tree of a case.yaml in `folder`. The schema
/// then reports its faults.
void complete_tree(YamlTree& root, const std::filesystem::path& folder,
                   const std::vector<Override>& overrides, std::vector<Finding>& findings);

}  // namespace dipper::cases
