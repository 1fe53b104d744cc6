// Effects: named departures from a case, each with one strength. A file EFFECT.yaml says what a
// strength does to the case's own keys, so an effect needs no code of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// What one unit of strength does to one key with value x:
/// add: x + factor s, scale: x (1 + factor s), set: factor s (x is ignored).
struct KeyChange {
  enum class How { add, scale, set };
  std::string key;  ///< dotted; `#` stands for every size class; NAME.0 for x of a vector
  How how = How::add;
  double factor = 0;
  Origin origin;
};

/// A file of the catalogue.
struct Effect {
  std::string name;
  std::string title;
  std::string kind;  ///< "rock", "machine" or "observation": the part of a run to repeat for it
  std::string signature;  ///< its effect on a mine's data, in words
  std::string parameter, unit;
  double low = 0, high = 0;  ///< bounds of the strength; 0, between them, is off
  double scale = 0;          ///< prior: normal about 0 with this standard deviation
  std::string source;        ///< of bounds and scale
  bool nuisance = false;     ///< varied within its prior, never named
  std::vector<KeyChange> changes;
};

/// EFFECT.yaml in `case_folder`/effects or in the catalogue (analysis/effects).
std::filesystem::path effect_file(const std::filesystem::path& case_folder,
                                  const std::string& name);

/// Names of both folders' effects, sorted.
std::vector<std::string> effect_names(const std::filesystem::path& case_folder);

/// Reads one file. Its faults are appended to `findings`, with their lines.
Effect read_effect(const std::filesystem::path& file, std::vector<Finding>& findings);

/// Applies the case's effects to its values, in the order of their names; no value is changed by
/// two effects. Appends a finding for an effect that does not exist, a strength out of bounds, and
/// a value that leaves its range.
void apply_effects(Case& c, std::vector<Finding>& findings);

}  // namespace dipper::cases
