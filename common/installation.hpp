#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// The path of a program of Dipper, such as "dipper-dem": beside this one (the build tree), else in
/// ../libexec/dipper (an installation).
std::string installed_program(const std::string& name);

/// The file that the system would start for `name`, by PATH; `name` itself where there is none.
std::string found_on_path(const std::string& name);

/// The folder of the data files: decks (dem_in), meshes, cases, machines (mbs), effects and the
/// Python packages (analysis), laid out as in the repository. It is the one that the program's main
/// has set, else ../share/dipper from this program; build tree and installation both have it there,
/// so no path is compiled in. Throws InputError when there is no such folder.
std::filesystem::path data_folder();
void set_data_folder(const std::filesystem::path& folder);

}  // namespace dipper
