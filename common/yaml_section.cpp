#include "common/yaml_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace dipper {
namespace {

bool is_list_of(const YamlTree& node, std::size_t count) {
  return node.kind == YamlTree::Kind::list && node.children.size() == count;
}

}  // namespace

YamlSection::YamlSection(std::string key, std::vector<Finding>& findings)
    : key_(std::move(key)), findings_(findings) {}

YamlSection::YamlSection(const YamlTree& node, std::string key, std::vector<Finding>& findings,
                         const std::string& what)
    : YamlSection(std::move(key), findings) {
  if (node.kind == YamlTree::Kind::map) {
    node_ = &node;
  } else {
    fault(node, "", fmt::format("is {}; write {}", shown(node), what));
  }
}

void YamlSection::fault(const YamlTree& at, const std::string& name, const std::string& message) {
  const std::string key = name.empty() || key_.empty() ? key_ + name : key_ + "." + name;
  findings_.push_back({at.origin.file, at.origin.line, key, message});
}

const YamlTree* YamlSection::find(const std::string& name) {
  known_.insert(name);
  return node_ == nullptr ? nullptr : node_->find(name);
}

const YamlTree* YamlSection::need(const std::string& name, const std::string& what) {
  const YamlTree* node = find(name);
  if (node == nullptr && node_ != nullptr) fault(*node_, name, "missing key; write " + what);
  return node;
}

YamlSection YamlSection::section(const std::string& name, const std::string& what) {
  const YamlTree* node = need(name, what);
  const std::string key = key_.empty() ? name : key_ + "." + name;
  return node == nullptr ? YamlSection(key, findings_) : YamlSection(*node, key, findings_, what);
}

std::string YamlSection::text(const std::string& name, const std::string& what) {
  const YamlTree* node = need(name, what);
  if (node == nullptr) return "";
  if (node->kind != YamlTree::Kind::scalar)
    fault(*node, name, fmt::format("is {}; write {}", shown(*node), what));
  return node->scalar;
}

double YamlSection::number(const std::string& name, const std::string& what, const Range& range) {
  const YamlTree* node = need(name, what);
  if (node == nullptr) return 0;
  const auto value = number_in<double>(*node);
  if (!value) {
    fault(*node, name, fmt::format("is {}; write {}", shown(*node), what));
  } else if (!range.holds(*value)) {
    fault(*node, name,
          fmt::format("{} is out of range; allowed is {}", node->scalar, range.text()));
  }
  return value.value_or(0);
}

std::vector<double> YamlSection::numbers(const std::string& name, std::size_t count,
                                         const std::string& what) {
  const YamlTree* node = need(name, what);
  return node == nullptr ? std::vector<double>(count) : numbers_at(*node, name, count, what);
}

std::vector<double> YamlSection::numbers_at(const YamlTree& node, const std::string& name,
                                            std::size_t count, const std::string& what) {
  std::vector<double> out(count);
  if (!is_list_of(node, count)) {
    fault(node, name, fmt::format("is {}; write {}", shown(node), what));
    return out;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const YamlTree& element = node.children[i].second;
    const auto value = number_in<double>(element);
    if (!value)
      fault(element, fmt::format("{}.{}", name, i),
            fmt::format("is {}; write {}", shown(element), what));
    out[i] = value.value_or(0);
  }
  return out;
}

Eigen::Vector3d YamlSection::vector(const std::string& name, const std::string& what) {
  const std::vector<double> v = numbers(name, 3, what);
  return {v[0], v[1], v[2]};
}

void YamlSection::refuse_others() {
  if (node_ == nullptr) return;
  for (const auto& [name, child] : node_->children)
    if (known_.count(name) == 0)
      fault(child, name, fmt::format("unknown key; known are {}", fmt::join(known_, ", ")));
}

}  // namespace dipper
