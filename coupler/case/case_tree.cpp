#include "coupler/case/case_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace fs = std::filesystem;

#include "common/resolved_path.hpp"

namespace dipper::cases {
namespace {

constexpr const char* kInclude = "include";

// Adds missing keys of another section; a list is taken as a whole or not at all.
void fill_missing_from(YamlTree& section, const YamlTree& other) {
  for (const auto& [name, theirs] : other.children) {
    YamlTree* mine = section.find(name);
    if (mine == nullptr) {
      section.children.emplace_back(name, theirs);
    } else if (mine->kind == YamlTree::Kind::map && theirs.kind == YamlTree::Kind::map) {
      fill_missing_from(*mine, theirs);
    }
  }
}

// `include: FILE`: sections that several cases share, in a file of their own, or another case. The
// keys of the file that includes override it. `from`: the files on the way here.
void merge_include(YamlTree& root, const fs::path& folder, std::vector<fs::path> from,
                   std::vector<Finding>& findings) {
  const auto at = std::find_if(root.children.begin(), root.children.end(),
                               [](const auto& child) { return child.first == kInclude; });
  if (at == root.children.end()) return;
  const YamlTree include = std::move(at->second);
  root.children.erase(at);
  const auto fault = [&](const std::string& message) {
    findings.push_back({include.origin.file, include.origin.line, kInclude, message});
  };
  if (include.kind != YamlTree::Kind::scalar || include.scalar.empty())
    return fault(fmt::format("is {}; write a path", shown(include)));
  const fs::path file = resolved(folder / include.scalar);
  if (!fs::is_regular_file(file)) return fault(file.string() + " is not a file");
  if (std::find(from.begin(), from.end(), file) != from.end())
    return fault(file.string() + " includes this file: a circle");
  from.push_back(file);
  YamlTree other = read_yaml(file, findings);
  merge_include(other, file.parent_path(), std::move(from), findings);
  fill_missing_from(root, other);
}

// Puts an override into the tree.
void apply(YamlTree& root, const Override& set, std::vector<Finding>& findings) {
  const fs::path from = "--set";
  const std::size_t before = findings.size();
  YamlTree value = parse_yaml(set.value, from, set.key, findings);
  if (findings.size() > before) return;
  YamlTree* node = &root;
  std::size_t begin = 0;
  while (true) {
    const std::size_t dot = set.key.find('.', begin);
    const std::string part = set.key.substr(begin, dot - begin);
    if (part.empty()) {
      findings.push_back({from, 0, set.key, "not a key; write --set section.key=value"});
      return;
    }
    YamlTree* child = node->find(part);
    // A list given by --set grows element by element, as in the lines of case.txt.
    const bool starts = node->kind == YamlTree::Kind::empty && part == "0";
    const bool goes_on = node->kind == YamlTree::Kind::list && node->origin.file == from &&
                         part == std::to_string(node->children.size());
    if (starts) node->kind = YamlTree::Kind::list;
    if (child == nullptr && node->kind == YamlTree::Kind::list && !starts && !goes_on) {
      findings.push_back(
          {from, 0, set.key,
           fmt::format("no element {}; the list has 0 ... {}", part, node->children.size() - 1)});
      return;
    }
    if (child == nullptr) {
      if (node->kind != YamlTree::Kind::list) node->kind = YamlTree::Kind::map;
      node->children.emplace_back(part, YamlTree{});
      child = &node->children.back().second;
      child->origin = {from, 0};
    }
    node = child;
    if (dot == std::string::npos) break;
    begin = dot + 1;
  }
  *node = std::move(value);
  node->origin = {from, 0};
}

// Classes given by --set replace the file's sieve.
void drop_sieve_for_set_classes(YamlTree& root) {
  YamlTree* rock = root.find("rock");
  const YamlTree* classes = rock != nullptr ? rock->find("classes") : nullptr;
  const YamlTree* sieve = rock != nullptr ? rock->find("sieve") : nullptr;
  if (classes == nullptr || sieve == nullptr) return;
  if (classes->origin.file != "--set" || sieve->origin.file == "--set") return;
  auto& sections = rock->children;
  sections.erase(std::find_if(sections.begin(), sections.end(),
                              [](const auto& child) { return child.first == "sieve"; }));
}

}  // namespace

void complete_tree(YamlTree& root, const fs::path& folder, const std::vector<Override>& overrides,
                   std::vector<Finding>& findings) {
  merge_include(root, folder, {folder / "case.yaml"}, findings);
  for (const Override& set : overrides) apply(root, set, findings);
  drop_sieve_for_set_classes(root);
}

}  // namespace dipper::cases
