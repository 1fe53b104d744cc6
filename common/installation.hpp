#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// A program of ours, such as "dipper-dem": beside this one (the build tree), else in
/// ../libexec/dipper (an installation).
std::string installed_program(const std::string& name);

/// What the programs read: decks (dem_in), meshes, cases, the machine (mbs), effects and the Python
/// package (analysis), laid out as in the repository. What the program's main has set, else
/// ../share/dipper from this program; both the build tree and an installation have it there, so no
/// path is compiled in. Throws InputError where there is no such folder.
std::filesystem::path data_folder();
void set_data_folder(const std::filesystem::path& folder);

}  // namespace dipper
