// `dipper page FILE.html`: a page of the JSON on standard input.
#pragma once

#include "common/reporter.hpp"
#include "coupler/cli/command.hpp"

namespace dipper::cli {

/// Writes a page for the parts of the tool in other languages; not for users.
Command add_page_command(CLI::App& app, Reporter& reporter);

}  // namespace dipper::cli
