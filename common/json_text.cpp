#include "common/json_text.hpp"

#include <istream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "common/text_file.hpp"

namespace dipper {

nlohmann::json parse_json(const std::string& text) { return nlohmann::json::parse(text); }

nlohmann::json read_json(std::istream& in) {
  return parse_json({std::istreambuf_iterator<char>(in), {}});
}

nlohmann::json read_json(const std::filesystem::path& file) {
  return parse_json(read_bytes(file).value_or(""));
}

nlohmann::json parse_json_or_discard(const std::string& text) {
  return nlohmann::json::parse(text, nullptr, false);
}

nlohmann::json read_json_or_discard(const std::filesystem::path& file) {
  return parse_json_or_discard(read_bytes(file).value_or(""));
}

}  // namespace dipper
