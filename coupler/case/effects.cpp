#include "coupler/case/effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "common/installation.hpp"
#include "common/numbers.hpp"
#include "coupler/case/pile_profile.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/case/suggest.hpp"
#include "coupler/case/yaml_tree.hpp"

namespace dipper::cases {
namespace fs = std::filesystem;
namespace {

/// One file's content, by key, with every fault noted at its line.
class Reader {
 public:
  Reader(fs::path file, std::vector<Finding>& findings) : file_(std::move(file)), out_(findings) {}

  void fault(const YamlTree& at, const std::string& key, const std::string& message) {
    out_.push_back({file_, at.origin.line, key, message});
  }

  /// The child, or nullptr after a fault.
  YamlTree* need(YamlTree& in, const std::string& key, const std::string& what) {
    YamlTree* node = in.find(key);
    if (node == nullptr) fault(in, key, "missing; write " + what);
    return node;
  }

  std::string text(YamlTree& in, const std::string& key, const std::string& what) {
    const YamlTree* node = need(in, key, what);
    return node == nullptr ? "" : node->scalar;
  }

  double number(YamlTree& in, const std::string& key, const std::string& what) {
    const YamlTree* node = need(in, key, what);
    if (node == nullptr) return 0;
    double value = 0;
    if (node->quoted || !dipper::parse_number(node->scalar, value)) {
      fault(*node, key, fmt::format("is '{}'; write {}", node->scalar, what));
    }
    return value;
  }

  void only(YamlTree& in, const std::string& section, const std::set<std::string>& known) {
    for (const auto& [key, node] : in.children) {
      if (known.count(key) == 0) {
        fault(node, section + key,
              fmt::format("unknown key; known are {}", fmt::join(known, ", ")));
      }
    }
  }

 private:
  fs::path file_;
  std::vector<Finding>& out_;
};

fs::path catalogue() { return data_folder() / "analysis" / "effects"; }

/// A pointer to the number at a dotted key of the case, of which there may be several (`#`).
std::vector<double*> numbers_at(Case& c, const std::string& key, const KeySpec*& found) {
  std::vector<double*> out;
  for (const KeySpec& spec : schema()) {
    for (const Place& place : places_of(c, spec)) {
      const std::string here = concrete_key(spec, place);
      const Slot slot = spec.slot(c, place);
      if (key == spec.key || key == here) {
        if (auto* const* x = std::get_if<double*>(&slot)) {
          out.push_back(*x);
          found = &spec;
        }
      }
      auto* const* v = std::get_if<Eigen::Vector3d*>(&slot);
      for (int i = 0; v != nullptr && i < 3; ++i) {
        if (key != fmt::format("{}.{}", here, i)) continue;
        out.push_back(&(**v)[i]);
        found = &spec;
      }
    }
  }
  return out;
}

}  // namespace

fs::path effect_file(const fs::path& case_folder, const std::string& name) {
  const fs::path own = case_folder / "effects" / (name + ".yaml");
  return fs::exists(own) ? own : catalogue() / (name + ".yaml");
}

std::vector<std::string> effect_names(const fs::path& case_folder) {
  std::set<std::string> names;
  for (const fs::path& folder : {case_folder / "effects", catalogue()}) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      if (entry.path().extension() == ".yaml") names.insert(entry.path().stem());
    }
  }
  return {names.begin(), names.end()};
}

Effect read_effect(const fs::path& file, std::vector<Finding>& findings) {
  Effect e;
  e.name = file.stem();
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    findings.push_back({file, 0, "", "cannot be read"});
    return e;
  }
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t before = findings.size();
  YamlTree root = parse_yaml(text, file, "", findings);
  if (findings.size() > before) return e;
  Reader read(file, findings);
  read.only(root, "", {"title", "kind", "parameter", "overlay", "signature", "nuisance"});
  e.title = read.text(root, "title", "one line for reports");
  e.kind = read.text(root, "kind", "rock, machine or observation");
  if (YamlTree* kind = root.find("kind")) {
    if (e.kind != "rock" && e.kind != "machine" && e.kind != "observation") {
      read.fault(*kind, "kind", fmt::format("is '{}'; write rock, machine or observation", e.kind));
    }
  }
  if (const YamlTree* signature = root.find("signature")) e.signature = signature->scalar;
  if (YamlTree* nuisance = root.find("nuisance")) {
    e.nuisance = nuisance->scalar == "true";
    if (!e.nuisance && nuisance->scalar != "false") {
      read.fault(*nuisance, "nuisance",
                 fmt::format("is '{}'; write true or false", nuisance->scalar));
    }
  }
  if (YamlTree* p = read.need(root, "parameter", "{name, unit, low, high, scale, source}")) {
    read.only(*p, "parameter.", {"name", "unit", "low", "high", "scale", "source"});
    e.parameter = read.text(*p, "name", "the parameter's name");
    e.unit = read.text(*p, "unit", "its unit, or -");
    e.low = read.number(*p, "low", "the lowest strength");
    e.high = read.number(*p, "high", "the highest strength");
    e.scale = read.number(*p, "scale", "the prior's standard deviation, in the unit");
    e.source = read.text(*p, "source", "where bounds and prior come from");
    if (p->find("scale") != nullptr && !(e.scale > 0)) {
      read.fault(*p, "parameter.scale", fmt::format("is {:g}; write a number above 0", e.scale));
    }
    if (e.low > 0 || e.high < 0 || e.low >= e.high) {
      read.fault(*p, "parameter", "low ... high must hold 0, which is off");
    }
  }
  if (YamlTree* overlay = read.need(root, "overlay", "KEY: {add|scale|set: factor}")) {
    for (auto& [key, node] : overlay->children) {
      KeyChange change{key, KeyChange::How::add, 0, node.origin};
      if (node.children.size() != 1 ||
          (!node.find("add") && !node.find("scale") && !node.find("set"))) {
        read.fault(node, key, "write one of {add: a}, {scale: a}, {set: a}");
        continue;
      }
      const std::string how = node.children[0].first;
      change.how = how == "add"     ? KeyChange::How::add
                   : how == "scale" ? KeyChange::How::scale
                                    : KeyChange::How::set;
      change.factor = read.number(node, how, "a number");
      e.changes.push_back(change);
    }
  }
  return e;
}

void apply_effects(Case& c, std::vector<Finding>& findings) {
  std::map<double*, std::string> taken;
  for (const auto& [name, strength] : c.effects) {
    const std::string key = "effects." + name;
    const fs::path file = effect_file(c.folder, name);
    if (!fs::exists(file)) {
      const auto known = effect_names(c.folder);
      const std::string near = closest(name, known);
      findings.push_back(
          finding_at(c, key,
                     fmt::format("there is no such effect{}; known are {}",
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near),
                                 fmt::join(known, ", "))));
      continue;
    }
    const std::size_t before = findings.size();
    const Effect effect = read_effect(file, findings);
    if (findings.size() > before) continue;
    if (strength < effect.low || strength > effect.high) {
      findings.push_back(
          finding_at(c, key,
                     fmt::format("{:g} is out of bounds; allowed is {:g} ... {:g} {}", strength,
                                 effect.low, effect.high, effect.unit)));
      continue;
    }
    if (strength == 0) continue;
    for (const KeyChange& change : effect.changes) {
      const KeySpec* spec = nullptr;
      const std::vector<double*> values = numbers_at(c, change.key, spec);
      if (values.empty()) {
        findings.push_back({file, change.origin.line, change.key, "is no number of a case"});
      }
      if (is_replaced_by_profile(c, change.key)) {
        findings.push_back(finding_at(
            c, key,
            fmt::format("changes {}, which pile.profile replaces; change the profile's points",
                        change.key)));
        continue;
      }
      for (double* x : values) {
        if (const auto other = taken.emplace(x, name); !other.second) {
          findings.push_back(finding_at(
              c, key,
              fmt::format("changes {}, as effects.{} does", change.key, other.first->second)));
        }
        if (change.how == KeyChange::How::scale && *x == 0) {
          findings.push_back(
              finding_at(c, key, fmt::format("scales {}, which is 0 in this case", change.key)));
        }
        switch (change.how) {
          case KeyChange::How::add:
            *x += change.factor * strength;
            break;
          case KeyChange::How::scale:
            *x *= 1 + change.factor * strength;
            break;
          case KeyChange::How::set:
            *x = change.factor * strength;
            break;
        }
        if (!spec->range.holds(*x)) {
          findings.push_back(finding_at(
              c, key,
              fmt::format("makes {} = {:g}; allowed is {}{}", change.key, *x, spec->range.text(),
                          spec->unit.empty() ? "" : " " + spec->unit)));
        }
      }
    }
  }
}

}  // namespace dipper::cases
