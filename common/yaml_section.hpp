// Reads a file of known keys: who reads asks for each by name, and what is wrong is noted.
#pragma once

#include <Eigen/Core>
#include <set>
#include <string>
#include <vector>

#include "common/range.hpp"
#include "common/yaml_tree.hpp"

namespace dipper {

/// A section of a file. A key that is missing or holds something else gives a finding at its line
/// and a value of zero or nothing; below a section that is missing nothing further is noted.
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

  /// Of a list that is an element of one: `name` is the element's key in this section.
  std::vector<double> numbers_at(const YamlTree& node, const std::string& name, std::size_t count,
                                 const std::string& what);

  /// The node of a key; nullptr after a finding.
  const YamlTree* need(const std::string& name, const std::string& what);

  /// The node of a key that may be missing; nullptr when it is.
  const YamlTree* find(const std::string& name);

  /// A finding for every key that nobody has asked for.
  void refuse_others();

  /// Notes a fault of the key `name`, or of the section itself when that is "".
  void fault(const YamlTree& at, const std::string& name, const std::string& message);

  bool is_there() const { return node_ != nullptr; }
  const YamlTree& node() const { return *node_; }  ///< of a section that is there

 private:
  YamlSection(std::string key, std::vector<Finding>& findings);  // one that is missing

  const YamlTree* node_ = nullptr;
  std::string key_;
  std::vector<Finding>& findings_;
  std::set<std::string> known_;
};

}  // namespace dipper
