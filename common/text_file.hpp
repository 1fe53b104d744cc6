// A file of text that is there whole or not at all.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Writes the file as these bytes, in place of what it held, which stays when they cannot be
/// written to the end: then std::runtime_error names the file.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace dipper
