// The page of a run without rock: kind "dry".
#pragma once

#include <filesystem>

namespace dipper::analysis::report {

/// Whether the folder holds a run without rock: its summary.json has a rock_model.
bool is_dry_run(const std::filesystem::path& folder);

/// Writes the page from record and summary: the machine at work over the bench, the path of the
/// teeth through each pass's face, forces, powers, and the machine's limits. Throws InputError
/// naming a file that cannot be read.
void write_dry_page(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace dipper::analysis::report
