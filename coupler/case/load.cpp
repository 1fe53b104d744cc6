// load_case: case.yaml and --set, through the schema, into a Case.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "common/nearest_word.hpp"
#include "common/resolved_path.hpp"
#include "common/text_file.hpp"
#include "common/yaml_tree.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/case_text.hpp"
#include "coupler/case/case_tree.hpp"
#include "coupler/case/effects.hpp"
#include "coupler/case/force_laws.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/case/pile_profile.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/case/sieve_classes.hpp"
#include "coupler/case/suggest.hpp"

namespace fs = std::filesystem;

namespace dipper::cases {
namespace {

std::string join_key(const std::string& section, const std::string& name) {
  return section.empty() ? name : section + "." + name;
}

class Loader {
 public:
  Loader(Case& c, std::vector<Finding>& findings) : case_(c), findings_(findings) {}

  void read_section(const YamlTree& node, const std::string& pattern, const std::string& key,
                    const Place& place) {
    if (node.kind != YamlTree::Kind::map) {
      return add(node, key,
                 fmt::format("is {}; write a section with the keys {}", shown(node),
                             fmt::join(children_of(pattern), ", ")));
    }
    const std::vector<std::string> known = children_of(pattern);
    const bool free_names = known.size() == 1 && known[0] == "*";
    std::set<std::string>
        meant;  // a misspelt key is one fault: its correct form is not reported as missing
    for (const auto& [name, child] : node.children) {
      if (free_names) {
        read(child, join_key(pattern, "*"), join_key(key, name), {place.index, name});
      } else if (std::find(known.begin(), known.end(), name) == known.end()) {
        const UnknownKey unknown = explain_unknown_key(pattern, name);
        add(child, join_key(key, name), unknown.message);
        meant.insert(unknown.meant);
      } else {
        read(child, join_key(pattern, name), join_key(key, name), place);
      }
    }
    if (free_names) {
      if (node.children.empty() && is_required(pattern)) {
        add(node, key, "is empty; write at least one entry");
      }
      return;
    }
    for (const std::string& name : known) {
      const std::string child = join_key(pattern, name);
      const bool replaced = (child == "rock.classes" && has(node, "sieve")) ||
                            is_replaced_by_profile(case_, child) || is_of_other_kind(case_, child);
      if (!has(node, name) && !meant.count(name) && !replaced && is_required(child)) {
        add(node, join_key(key, name), missing_message(child));
      }
    }
  }

 private:
  static bool has(const YamlTree& node, const std::string& name) {
    return std::any_of(node.children.begin(), node.children.end(),
                       [&](const auto& child) { return child.first == name; });
  }

  static std::string missing_message(const std::string& pattern) {
    const KeySpec* spec = find_spec(pattern);
    if (spec == nullptr) {
      return fmt::format("missing section, with the keys {}",
                         fmt::join(children_of(pattern), ", "));
    }
    return fmt::format("missing key; write {}: {}", spec->expected(), spec->doc);
  }

  void add(const YamlTree& node, const std::string& key, const std::string& message) {
    findings_.push_back({node.origin.file, node.origin.line, key, message});
  }

  void read(const YamlTree& node, const std::string& pattern, const std::string& key,
            const Place& place) {
    case_.origins[key] = node.origin;
    if (const KeySpec* spec = find_spec(pattern)) {
      std::visit([&](const auto& slot) { read_value(node, key, *spec, slot); },
                 spec->slot(case_, place));
    } else if (children_of(pattern) == std::vector<std::string>{"#"}) {
      read_list(node, pattern + ".#", key);
    } else {
      read_section(node, pattern, key, place);
    }
  }

  void read_list(const YamlTree& node, const std::string& pattern, const std::string& key) {
    if (node.kind != YamlTree::Kind::list || node.children.empty()) {
      return add(node, key,
                 fmt::format("is {}; write a list with at least one entry of {}",
                             node.children.empty() ? "empty" : shown(node),
                             fmt::join(children_of(pattern), ", ")));
    }
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const std::string element_key = join_key(key, std::to_string(i));
      case_.origins[element_key] = node.children[i].second.origin;
      read_section(node.children[i].second, pattern, element_key, {i, ""});
    }
  }

  void wrong_type(const YamlTree& node, const std::string& key, const KeySpec& spec) {
    add(node, key, fmt::format("is {}; write {}", shown(node), spec.expected()));
  }

  void check_range(const YamlTree& node, const std::string& key, const KeySpec& spec, double x) {
    if (spec.range.holds(x)) return;
    add(node, key,
        fmt::format("{} is out of range; allowed is {}{}", node.scalar, spec.range.text(),
                    spec.unit.empty() ? "" : " " + spec.unit));
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec, double* out) {
    const bool word =
        std::find(spec.allowed.begin(), spec.allowed.end(), node.scalar) != spec.allowed.end();
    const auto value = word ? std::optional<double>(0) : number_in<double>(node);
    if (!value) return wrong_type(node, key, spec);
    *out = *value;
    if (!word) check_range(node, key, spec, *out);
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  std::int64_t* out) {
    const auto value = number_in<std::int64_t>(node);
    if (!value) return wrong_type(node, key, spec);
    *out = *value;
    check_range(node, key, spec, static_cast<double>(*out));
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec, int* out) {
    const auto value = number_in<std::int64_t>(node);
    if (!value) return wrong_type(node, key, spec);
    check_range(node, key, spec, static_cast<double>(*value));
    *out = static_cast<int>(*value);
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  std::string* out) {
    if (node.kind != YamlTree::Kind::scalar) return wrong_type(node, key, spec);
    *out = node.scalar;
    if (!spec.allowed.empty()) word_at(node, key, spec);
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  const Choice& out) {
    if (node.kind != YamlTree::Kind::scalar) return wrong_type(node, key, spec);
    if (const auto word = word_at(node, key, spec)) out.set(*word);
  }

  /// The index among the allowed words; another word is a finding.
  std::optional<std::size_t> word_at(const YamlTree& node, const std::string& key,
                                     const KeySpec& spec) {
    const auto word = std::find(spec.allowed.begin(), spec.allowed.end(), node.scalar);
    if (word != spec.allowed.end()) return word - spec.allowed.begin();
    const std::string near = nearest_word(node.scalar, spec.allowed);
    add(node, key,
        fmt::format("is {}; write {}{}", shown(node), spec.expected(),
                    near.empty() ? "" : fmt::format("; did you mean {}?", near)));
    return std::nullopt;
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  fs::path* out) {
    if (node.kind != YamlTree::Kind::scalar || node.scalar.empty()) {
      return wrong_type(node, key, spec);
    }
    // Relative to the file that has it; for --set, to the case.
    const bool by_hand = node.origin.line == 0;
    const fs::path from = by_hand ? case_.folder : fs::absolute(node.origin.file).parent_path();
    *out = resolved(from / node.scalar);
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  Eigen::Vector3d* out) {
    if (node.kind != YamlTree::Kind::list || node.children.size() != 3) {
      return wrong_type(node, key, spec);
    }
    for (int i = 0; i < 3; ++i) {
      const YamlTree& element = node.children[static_cast<std::size_t>(i)].second;
      const auto value = number_in<double>(element);
      const std::string element_key = join_key(key, std::to_string(i));
      if (value) {
        (*out)[i] = *value;
        check_range(element, element_key, spec, (*out)[i]);
      } else {
        add(element, element_key,
            fmt::format("is {}; write {}", shown(element),
                        "a number" + (spec.unit.empty() ? "" : " in " + spec.unit)));
      }
    }
  }

  void read_value(const YamlTree& node, const std::string& key, const KeySpec& spec,
                  std::vector<std::string>* out) {
    if (node.kind != YamlTree::Kind::list || node.children.empty()) {
      return wrong_type(node, key, spec);
    }
    for (const auto& [index, element] : node.children) {
      case_.origins[join_key(key, index)] = element.origin;
      if (element.kind != YamlTree::Kind::scalar) {
        add(element, join_key(key, index), fmt::format("is {}; write a name", shown(element)));
      } else {
        out->push_back(element.scalar);
      }
    }
  }

  Case& case_;
  std::vector<Finding>& findings_;
};

bool is_identifier(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char ch) {
    return std::isalnum(ch) || ch == '_';
  });
}

// Checks of several keys together. Uses only values that loaded without a finding.
void check_between_keys(const Case& c, std::vector<Finding>& findings) {
  const auto sound = [&, known = findings](const std::string& key) {
    return c.origins.count(key) && std::none_of(known.begin(), known.end(), [&](const Finding& f) {
             return f.key == key || f.key.compare(0, key.size() + 1, key + ".") == 0;
           });
  };
  const std::string word = "letters, digits and _ only";

  std::set<std::string> names;
  double percent = 0;
  bool all_percents = true;  // otherwise their sum adds no information
  for (std::size_t i = 0; i < c.rock.classes.size(); ++i) {
    const SizeClass& size = c.rock.classes[i];
    const std::string key = fmt::format("rock.classes.{}", i);
    percent += size.mass_percent;
    all_percents = all_percents && sound(key + ".mass_percent");
    if (sound(key + ".name")) {
      if (!is_identifier(size.name)) {
        findings.push_back(finding_at(c, key + ".name", "is a name; write " + word));
      } else if (!names.insert(size.name).second) {
        findings.push_back(
            finding_at(c, key + ".name", fmt::format("'{}' names two classes", size.name)));
      }
    }
    for (std::size_t j = 0; j < size.shapes.size(); ++j) {
      if (is_identifier(size.shapes[j])) continue;
      findings.push_back(
          finding_at(c, fmt::format("{}.shapes.{}", key, j),
                     fmt::format("'{}' names no shape; write {}", size.shapes[j], word)));
    }
  }
  if (!c.rock.classes.empty() && all_percents && std::abs(percent - 100) > 0.1) {
    findings.push_back(finding_at(
        c, "rock.classes",
        fmt::format("mass_percent adds up to {:.6g}; the classes must add up to 100", percent)));
  }
  for (const auto& body : c.bodies) {
    if (is_identifier(body.first)) continue;
    findings.push_back(finding_at(c, "bodies." + body.first, "is a name; write " + word));
  }
  if (c.dem.hold_below_m_s > 0 && c.crust.tensile_strength_Pa > 0) {
    findings.push_back(
        finding_at(c, "dem.hold_below_m_s",
                   "cannot be used with a crust, because bonds are not computed in rock "
                   "that is held; leave one of the two out"));
  }
  if (c.pile.held_layer_m > 0 && c.crust.tensile_strength_Pa > 0) {
    findings.push_back(
        finding_at(c, "pile.held_layer_m",
                   "cannot be used with a crust, because bonds are not computed in rock "
                   "that is held; leave one of the two out"));
  }
  if (sound("domain.min_m") && sound("domain.max_m")) {
    for (int i = 0; i < 3; ++i) {
      if (c.domain.min_m[i] < c.domain.max_m[i]) continue;
      findings.push_back(finding_at(c, "domain.min_m",
                                    fmt::format("{} = {} is not below domain.max_m's {}", "xyz"[i],
                                                c.domain.min_m[i], c.domain.max_m[i])));
    }
  }
}

}  // namespace

ContactCase of_every_pair(ContactCase k) {
  const auto as = [](std::optional<double>& value, double another) {
    value = value.value_or(another);
  };
  as(k.normal_damping_other, k.normal_damping);
  as(k.tangential_damping_other, k.tangential_damping);
  as(k.friction_truck_sphere, k.friction_truck);
  as(k.rolling_friction_rock, k.rolling_friction_sphere);
  as(k.rolling_friction_dipper, k.rolling_friction_sphere);
  as(k.rolling_friction_truck, k.rolling_friction_ground);
  return k;
}

Finding finding_at(const Case& c, const std::string& key, const std::string& message) {
  std::string known = key;
  while (!c.origins.count(known)) {
    const auto dot = known.rfind('.');
    if (dot == std::string::npos) return {c.folder / "case.yaml", 0, key, message};
    known.resize(dot);
  }
  const Origin& origin = c.origins.at(known);
  return {origin.file, origin.line, key, message};
}

void add_file_findings(const Case& c, const std::string& key, const InputError& error,
                       std::vector<Finding>& findings) {
  for (Finding f : error.findings()) {
    if (f.line == 0) {
      f = finding_at(c, key, to_string(f));
    } else if (!f.key.empty()) {
      f.message = f.key + ": " + f.message;
    }
    f.key = key;
    findings.push_back(f);
  }
}

Case load_case(const fs::path& folder, const std::vector<Override>& overrides,
               std::vector<Finding>& findings) {
  Case c;
  c.folder = resolved(folder);
  c.name = c.folder.filename().string();

  const fs::path file = folder / "case.yaml";
  const std::optional<std::string> text = read_bytes(file);
  if (!text) {
    const bool is_file = fs::is_regular_file(folder);
    findings.push_back(
        {is_file ? folder : file, 0, "",
         is_file ? fmt::format("is a file; name its folder, {}",
                               folder.has_parent_path() ? folder.parent_path().string() : ".")
                 : "cannot be read; a case is a folder with a case.yaml"});
    return c;
  }
  const std::size_t before = findings.size();
  if (first_not_utf8(c.folder.string()))
    findings.push_back({file, 0, "", "the folder's name is not UTF-8; rename it"});
  YamlTree root = parse_yaml(*text, file, "", findings);
  const bool syntax_error = findings.size() > before && root.kind == YamlTree::Kind::empty;
  complete_tree(root, c.folder, overrides, findings);
  if (syntax_error) return c;  // every key would seem to be missing

  Loader(c, findings).read_section(root, "", "", {});
  if (findings.size() == before) make_sieve_classes(c, findings);
  check_machine_kind(c, findings);
  read_pile_profile(c, findings);
  if (findings.size() == before) apply_effects(c, findings);
  check_force_laws(c, findings);
  c.contact = of_every_pair(c.contact);
  check_between_keys(c, findings);
  sort_by_line(findings, before);
  c.text = case_text(c);
  return c;
}

}  // namespace dipper::cases
