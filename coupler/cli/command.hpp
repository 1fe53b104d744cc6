// A subcommand of dipper: each is added by a file of its own.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace dipper::cli {

struct Command {
  CLI::App* subcommand;  ///< its part of the command line
  /// What it does once the line is parsed. Returns the exit status; throws CLI::ValidationError for
  /// words that parse but say nothing sensible.
  std::function<int()> run;
};

}  // namespace dipper::cli
