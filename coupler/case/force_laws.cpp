#include "coupler/case/force_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/signals/drive_terms.hpp"
#include "common/nearest_word.hpp"

namespace dipper::cases {

bool is_law(const KeySpec& spec) {
  return spec.key == "observation.hoist_law.*" || spec.key == "observation.crowd_law.*";
}

std::string no_term(const std::string& name) {
  const auto& terms = analysis::signals::kDriveTerms;
  const std::string near = nearest_word(name, {terms.begin(), terms.end()});
  return fmt::format("is not a term of the motion{}; known are {}",
                     near.empty() ? "" : fmt::format("; did you mean {}?", near),
                     fmt::join(terms, ", "));
}

void check_force_laws(const Case& c, std::vector<Finding>& findings) {
  for (const KeySpec& spec : schema()) {
    if (!is_law(spec)) continue;
    for (const Place& place : places_of(c, spec))
      if (!analysis::signals::is_drive_term(place.name))
        findings.push_back(finding_at(c, concrete_key(spec, place), no_term(place.name)));
  }
}

}  // namespace dipper::cases
