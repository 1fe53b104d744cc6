#include "coupler/case/effects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "common/installation.hpp"
#include "common/nearest_word.hpp"
#include "common/yaml_section.hpp"
#include "coupler/case/force_laws.hpp"
#include "coupler/case/pile_profile.hpp"
#include "coupler/case/schema.hpp"

namespace dipper::cases {
namespace fs = std::filesystem;
namespace {

fs::path catalogue() { return data_folder() / "analysis" / "effects"; }

/// A pointer to the number at a dotted key of the case, of which there may be several (`#`).
std::vector<double*> numbers_at(Case& c, const std::string& key, const KeySpec*& found) {
  std::vector<double*> out;
  for (const KeySpec& spec : schema()) {
    std::vector<Place> places = places_of(c, spec);
    if (is_law(spec) && spec_of(key) == &spec)  // a term that the law does not have yet
      places = {{0, key.substr(key.rfind('.') + 1)}};
    for (const Place& place : places) {
      const std::string here = concrete_key(spec, place);
      if (key != spec.key && key.rfind(here, 0) != 0)
        continue;  // a key that takes another's value keeps doing so
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
  const std::size_t before = findings.size();
  const YamlTree tree = read_yaml(file, findings);
  if (findings.size() > before) return e;
  YamlSection root(tree, "", findings);
  e.title = root.text("title", "one line for reports");
  e.kind = root.text("kind", "rock, machine or observation");
  if (const YamlTree* kind = root.find("kind")) {
    if (e.kind != "rock" && e.kind != "machine" && e.kind != "observation")
      root.fault(*kind, "kind", fmt::format("is '{}'; write rock, machine or observation", e.kind));
  }
  if (const YamlTree* signature = root.find("signature")) e.signature = signature->scalar;
  if (const YamlTree* nuisance = root.find("nuisance")) {
    e.nuisance = nuisance->scalar == "true";
    if (!e.nuisance && nuisance->scalar != "false")
      root.fault(*nuisance, "nuisance",
                 fmt::format("is {}; write true or false", shown(*nuisance)));
  }
  YamlSection p = root.section("parameter", "{name, unit, low, high, scale, source}");
  e.parameter = p.text("name", "the parameter's name");
  e.unit = p.text("unit", "its unit, or -");
  e.low = p.number("low", "the lowest strength");
  e.high = p.number("high", "the highest strength");
  e.scale = p.number("scale", "the prior's standard deviation, in the unit", {0, 1e300, true});
  e.source = p.text("source", "where bounds and prior come from");
  p.refuse_others();
  if (p.is_there() && (e.low > 0 || e.high < 0 || e.low >= e.high))
    p.fault(p.node(), "", "low ... high must contain 0, which means off");
  YamlSection overlay = root.section("overlay", "KEY: {add|scale|set: factor}");
  for (std::size_t k = 0; overlay.is_there() && k < overlay.node().children.size(); ++k) {
    const auto& [key, node] = overlay.node().children[k];
    if (node.children.size() != 1 ||
        (!node.find("add") && !node.find("scale") && !node.find("set"))) {
      overlay.fault(node, key, "write one of {add: a}, {scale: a}, {set: a}");
      continue;
    }
    KeyChange change{key, KeyChange::How::add, 0, node.origin};
    const std::string how = node.children[0].first;
    change.how = how == "add"     ? KeyChange::How::add
                 : how == "scale" ? KeyChange::How::scale
                                  : KeyChange::How::set;
    change.factor = overlay.section(key, "").number(how, "a number");
    e.changes.push_back(change);
  }
  root.refuse_others();
  return e;
}

void apply_effects(Case& c, std::vector<Finding>& findings) {
  std::map<double*, std::string> taken;
  for (const auto& [name, strength] : c.effects) {
    const std::string key = "effects." + name;
    const fs::path file = effect_file(c.folder, name);
    if (!fs::exists(file)) {
      const auto known = effect_names(c.folder);
      const std::string near = nearest_word(name, known);
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
    std::vector<Finding> zeros;  // scaled, and 0 all the same; a fault where nothing else changes
    bool changes = false;
    for (const KeyChange& change : effect.changes) {
      const KeySpec* spec = nullptr;
      const std::vector<double*> values = numbers_at(c, change.key, spec);
      if (values.empty()) {
        findings.push_back({file, change.origin.line, change.key, "is not a number of the case"});
      }
      if (change.key.rfind("rock.sieve.", 0) == 0) {  // the classes are made by now
        findings.push_back({file, change.origin.line, change.key,
                            "is read before effects; change rock.classes.#.size_m"});
        continue;
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
          zeros.push_back(
              finding_at(c, key, fmt::format("scales {}, which is 0 in this case", change.key)));
        } else {
          changes = true;
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
    if (!changes) findings.insert(findings.end(), zeros.begin(), zeros.end());
  }
}

}  // namespace dipper::cases
