// The file that a command writes, checked before the work that would be lost without it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cli {

/// Throws InputError unless the folder that `file` goes into exists and may be written into;
/// `remedy` says what to do then.
void require_place(const std::filesystem::path& file, const std::string& remedy);

/// The same for a file given with `option`, which may be none of the inputs, by whatever name.
void require_output(const std::filesystem::path& file, const std::string& option,
                    const std::vector<std::filesystem::path>& inputs);

/// case.yaml and the files that a case names.
std::vector<std::filesystem::path> inputs_of(const cases::Case& c);

}  // namespace dipper::cli
