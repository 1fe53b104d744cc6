// Reads a file of known keys: the caller asks for each by name, and faults are collected.
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "common/range.hpp"
#include "common/yaml_tree.hpp"

namespace dipper {

/// A section of a file. A key that is missing or of another kind gives a finding at its line and a
/// zero or empty value; a missing section gives no further findings below it.
/// `what` says what belongs at a key: "a number in m". The tree must outlive the section.
class YamlSection {
 public:
  /// The whole file, when `key` is "", or the section of that dotted key.
  YamlSection(const YamlTree& node, std::string key, std::vector<Finding>& findings,
              const std::string& what = "a section of keys");

  YamlSection section(const std::string& name, const std::string& what);
  std::string text(const std::string& name, const std::string& what);
  double number(const std::string& name, const std::string& what, const Range& range = {});
  std::vector<double> numbers(const std::string& name, std::size_t count, const std::string& what);
  Eigen::Vector3d vector(const std::string& name, const std::string& what);

  /// For a list that is an element of a list: `name` is the element's key in this section.
  std::vector<double> numbers_at(const YamlTree& node, const std::string& name, std::size_t count,
                                 const std::string& what);

  /// The node of a key; nullptr after a finding.
  const YamlTree* need(const std::string& name, const std::string& what);

  /// The node of a key that may be missing; nullptr when it is.
  const YamlTree* find(const std::string& name);

  /// Adds a finding for every key that was not asked for.
  void refuse_others();

  /// Adds a fault of the key `name`, or of the section itself when that is "".
  void fault(const YamlTree& at, const std::string& name, const std::string& message);

  bool is_there() const { return node_ != nullptr; }
  const YamlTree& node() const { return *node_; }  ///< only for a section that exists

 private:
  YamlSection(std::string key, std::vector<Finding>& findings);  // a missing one

  const YamlTree* node_ = nullptr;
  std::string key_;
  std::vector<Finding>& findings_;
  std::set<std::string> known_;
};

}  // namespace dipper
