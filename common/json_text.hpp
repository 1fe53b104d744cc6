// JSON read from text. The parser is compiled here alone.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace dipper {

/// Throws nlohmann::json::parse_error when the text is not JSON.
nlohmann::json parse_json(const std::string& text);

/// The JSON in a stream to its end, or in a file; throws the same, also when the file cannot be
/// read.
nlohmann::json read_json(std::istream& in);
nlohmann::json read_json(const std::filesystem::path& file);

/// Discarded (is_discarded(), hence no object) when the text is not JSON.
nlohmann::json parse_json_or_discard(const std::string& text);

/// The JSON in a file; discarded also when the file cannot be read.
nlohmann::json read_json_or_discard(const std::filesystem::path& file);

}  // namespace dipper
