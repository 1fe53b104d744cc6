#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dipper {

/// SHA-256 as 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

/// The same of a file's bytes. Throws std::runtime_error when it cannot be read.
std::string sha256_file(const std::filesystem::path& file);

}  // namespace dipper
