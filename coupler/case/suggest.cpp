#include "coupler/case/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

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

std::string plain(const std::string& key) {  // "rock.classes.#" as people say it
  const auto hash = key.find(".#");
  return hash == std::string::npos ? key : key.substr(0, hash);
}

}  // namespace

int edit_distance(const std::string& a_in, const std::string& b_in) {
  const std::string a = lower(a_in);
  const std::string b = lower(b_in);
  // Optimal string alignment: three rows of the usual table.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string closest(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  int best_distance = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string& candidate : known) {
    const int distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

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
  const std::string near = closest(key, siblings);
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
