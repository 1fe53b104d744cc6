// A subcommand of dipper: each is added by a file of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace dipper::cli {

struct Command {
  CLI::App* subcommand;  ///< its part of the command line
  /// Runs the command after the command line is parsed. Returns the exit status; throws
  /// CLI::ValidationError for options that parse but make no sense together.
  std::function<int()> run;
};

}  // namespace dipper::cli
