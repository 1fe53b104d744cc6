// The dump of the settled pile.
#pragma once

#include <filesystem>

#include "analysis/io/dump_reader.hpp"

namespace dipper::result {

/// The text dump of the particles with the lowest step in a run's folder of dumps; empty: there is
/// none.
inline std::filesystem::path first_dump(const std::filesystem::path& folder) {
  std::filesystem::path first;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (analysis::io::without_gz(entry.path()).extension() != ".dump" ||
        !analysis::io::step_in_name(entry.path()))
      continue;
    if (first.empty() ||
        *analysis::io::step_in_name(entry.path()) < *analysis::io::step_in_name(first))
      first = entry.path();
  }
  return first;
}

}  // namespace dipper::result
