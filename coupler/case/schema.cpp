#include "coupler/case/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace dipper::cases {
namespace {

// The name of a slot's type, singular, as in "write ...".
struct TypeName {
  std::string operator()(double*) const { return "a number"; }
  std::string operator()(int*) const { return "a whole number"; }
  std::string operator()(std::int64_t*) const { return "a whole number"; }
  std::string operator()(std::string*) const { return "text"; }
  std::string operator()(std::filesystem::path*) const { return "a path"; }
  std::string operator()(Eigen::Vector3d*) const { return "three numbers [x, y, z]"; }
  std::string operator()(std::vector<std::string>*) const { return "a list of names"; }
  std::string operator()(const Choice&) const { return "text"; }
};

std::string type_name(const KeySpec& spec) {
  Case scratch;
  return std::visit(TypeName{}, spec.slot(scratch, {}));
}

}  // namespace

std::string KeySpec::leaf() const { return key.substr(key.rfind('.') + 1); }

std::string KeySpec::stem() const {
  const std::string name = leaf();
  return name.substr(0, name.size() - unit_suffix(unit).size());
}

std::string KeySpec::expected() const {
  const std::string type = type_name(*this), words = fmt::format("{}", fmt::join(allowed, ", "));
  if (!allowed.empty() && type == "text") return "one of " + words;
  return type + (unit.empty() ? "" : " in " + unit) + (allowed.empty() ? "" : ", or " + words);
}

const KeySpec* find_spec(const std::string& key) {
  const auto it = std::find_if(schema().begin(), schema().end(),
                               [&](const KeySpec& spec) { return spec.key == key; });
  return it == schema().end() ? nullptr : &*it;
}

const KeySpec* spec_of(const std::string& key) {
  const auto is_at = [&](const std::string& pattern) {
    std::size_t at = 0;
    for (const char c : pattern) {
      if (c != '#' && c != '*') {
        if (at >= key.size() || key[at++] != c) return false;
        continue;
      }
      const std::size_t begin = at;
      while (at < key.size() && (c == '#' ? std::isdigit(key[at]) != 0 : key[at] != '.')) ++at;
      if (at == begin) return false;
    }
    const std::string rest = key.substr(at);
    return rest.empty() || (rest.size() == 2 && rest[0] == '.' && std::isdigit(rest[1]) != 0);
  };
  const auto it = std::find_if(schema().begin(), schema().end(), [&](const KeySpec& spec) {
    return spec.key == key || is_at(spec.key);
  });
  return it == schema().end() ? nullptr : &*it;
}

bool is_path(const KeySpec& spec) {
  Case scratch;
  return std::holds_alternative<std::filesystem::path*>(spec.slot(scratch, {}));
}

std::string to_string(Affects affects) {
  switch (affects) {
    case Affects::settling:
      return "settling";
    case Affects::dig:
      return "dig";
    case Affects::machine:
      return "machine";
    case Affects::instruments:
      return "instruments";
    default:
      return "output";
  }
}

std::vector<std::string> children_of(const std::string& section) {
  const std::string prefix = section.empty() ? "" : section + ".";
  std::vector<std::string> names;
  for (const KeySpec& spec : schema()) {
    if (spec.key.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string rest = spec.key.substr(prefix.size());
    const std::string name = rest.substr(0, rest.find('.'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

bool is_required(const std::string& key_or_section) {
  return std::any_of(schema().begin(), schema().end(), [&](const KeySpec& spec) {
    return spec.required &&
           (spec.key == key_or_section ||
            spec.key.compare(0, key_or_section.size() + 1, key_or_section + ".") == 0);
  });
}

std::vector<Place> places_of(const Case& c, const KeySpec& spec) {
  std::vector<Place> places;
  if (spec.key.find('#') != std::string::npos) {
    for (std::size_t i = 0; i < c.rock.classes.size(); ++i) places.push_back({i, ""});
  } else if (spec.key.find('*') != std::string::npos) {
    const auto add = [&](const auto& entries) {
      for (const auto& entry : entries) places.push_back({0, entry.first});
    };
    if (spec.key == "effects.*") add(c.effects);
    if (spec.key == "bodies.*") add(c.bodies);
    if (spec.key == "observation.hoist_law.*") add(c.observation.hoist_law);
    if (spec.key == "observation.crowd_law.*") add(c.observation.crowd_law);
  } else {
    places.push_back({});
  }
  return places;
}

std::string concrete_key(const KeySpec& spec, const Place& place) {
  std::string key = spec.key;
  const auto hash = key.find('#');
  if (hash != std::string::npos) key.replace(hash, 1, std::to_string(place.index));
  const auto star = key.find('*');
  if (star != std::string::npos) key.replace(star, 1, place.name);
  return key;
}

std::string word_of(const Case& c, const std::string& key) {
  const KeySpec* spec = find_spec(key);
  Case copy = c;  // a slot gives write access
  return spec->allowed.at(std::get<Choice>(spec->slot(copy, {})).get());
}

std::string unit_suffix(const std::string& unit) {
  if (unit.empty()) return "";
  if (unit == "%") return "_percent";
  std::string suffix = "_" + unit;
  std::replace(suffix.begin(), suffix.end(), '/', '_');
  return suffix;
}

std::string schema_markdown() {
  std::string table =
      "| key | value | range | required | affects | meaning |\n|---|---|---|---|---|---|\n";
  for (const KeySpec& spec : schema()) {
    table += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", spec.key, spec.expected(),
                         spec.range.text(), spec.required ? "yes" : "no", to_string(spec.affects),
                         spec.doc);
  }
  return table;
}

}  // namespace dipper::cases
