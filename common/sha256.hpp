#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dipper {

/// SHA-256 as 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

/// The same of a file's bytes. Throws std::runtime_error when it cannot be read.
std::string sha256_file(const std::filesystem::path& file);

/// HMAC-SHA256 (RFC 2104), its 32 bytes as they are.
std::string hmac_sha256(std::string_view key, std::string_view bytes);

}  // namespace dipper
