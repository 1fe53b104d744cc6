// The commands that Python programs of analysis/ carry out. Their options are declared here, so
// that help, completion and manual page have them; the Python program then reads the command line
// as typed. `integration.help` compares the two lists.
#pragma once

#include <string>
#include <vector>

#include "coupler/cli/command.hpp"

namespace dipper::cli {

/// \param words the command line without the program's name
Command add_import_command(CLI::App& app, const std::vector<std::string>& words);
Command add_survey_command(CLI::App& app, const std::vector<std::string>& words);
Command add_study_command(CLI::App& app, const std::vector<std::string>& words);
Command add_gap_command(CLI::App& app, const std::vector<std::string>& words);

}  // namespace dipper::cli
