#include "coupler/case/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

#include "common/nearest_word.hpp"
#include "coupler/case/schema.hpp"

namespace dipper::cases {
namespace {

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char ch) { return static_cast<char>(std::tolower(ch)); });
  return s;
}

// True for "t_m3", "mm", "GPa": every part is a unit someone might write.
bool is_unit(const std::string& words) {
  static const std::array<const char*, 36> units = {
      "kg",  "g",  "t",  "ton", "tonne", "lb",  "m",   "m2",  "m3",      "mm",  "cm",  "cm3",
      "km",  "ft", "in", "l",   "pa",    "kpa", "mpa", "gpa", "n",       "kn",  "psi", "deg",
      "rad", "s",  "ms", "us",  "ns",    "sec", "min", "h",   "percent", "pct", "per", "ratio"};
  std::istringstream in(lower(words));
  bool any = false;
  for (std::string word; std::getline(in, word, '_'); any = true) {
    if (std::find(units.begin(), units.end(), word) == units.end()) return false;
  }
  return any;
}

std::string plain(const std::string& key) {  // "rock.classes.#" as users write it
  const auto hash = key.find(".#");
  return hash == std::string::npos ? key : key.substr(0, hash);
}

}  // namespace

UnknownKey explain_unknown_key(const std::string& section, const std::string& key) {
  const std::string prefix = section.empty() ? "" : section + ".";
  const std::vector<std::string> siblings = children_of(section);
  for (const std::string& sibling : siblings) {
    const KeySpec* spec = find_spec(prefix + sibling);
    if (spec == nullptr || spec->unit.empty()) continue;
    const std::string stem = spec->stem();
    const bool other_unit = key.size() > stem.size() + 1 &&
                            key.compare(0, stem.size() + 1, stem + "_") == 0 &&
                            is_unit(key.substr(stem.size() + 1));
    if (key == stem || other_unit) {
      return {fmt::format("unknown key; the unit here is {}: {}", spec->unit, sibling), sibling};
    }
  }
  const std::string near = nearest_word(key, siblings);
  if (!near.empty()) return {fmt::format("unknown key; did you mean {}?", near), near};
  for (const KeySpec& spec : schema()) {
    if (spec.leaf() != key) continue;
    const auto dot = spec.key.rfind('.');
    return {dot == std::string::npos
                ? "unknown key; it belongs outside of all sections"
                : "unknown key; it belongs in " + plain(spec.key.substr(0, dot)),
            ""};
  }
  return {fmt::format("unknown key; {} has {}", section.empty() ? "a case" : plain(section),
                      fmt::join(siblings, ", ")),
          ""};
}

}  // namespace dipper::cases
