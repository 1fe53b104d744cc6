// A program of the user's that drives the machine (docs/operator_program.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dipper::operate {

/// What the user asked for.
struct Program {
  std::string command;           ///< words, quoted as for a shell
  std::filesystem::path folder;  ///< in which it works
  bool sees_truth = false;       ///< what no instrument of a machine shows, too
};

/// It is asked at the first sync step that begins at a multiple of this, or after it.
constexpr std::int64_t kLook_ns = 100'000'000;

}  // namespace dipper::operate
