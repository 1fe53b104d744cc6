#include "common/json_text.hpp"

#include <nlohmann/json.hpp>

#include "common/text_file.hpp"

namespace dipper {

nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

nlohmann::json parse_json_or_discard(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, false);
}

nlohmann::json read_json_or_discard(const std::filesystem::path& file) {
  return parse_json_or_discard(read_bytes(file).value_or(""));
}

}  // namespace dipper
