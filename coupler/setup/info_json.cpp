#include "coupler/setup/info_json.hpp"

#include <nlohmann/json.hpp>

#include "common/json_text.hpp"

namespace dipper::setup {

std::string to_json(const core::ServerInfo& info) {
  nlohmann::json j{{"version", info.version},
                   {"bodies", info.bodies},
                   {"timestep_s", info.timestep_s},
                   {"channels", nlohmann::json::array()}};
  for (const auto& c : info.channels) {
    j["channels"].push_back({{"name", c.name}, {"unit", c.unit}, {"frame", c.frame}});
  }
  return j.dump();
}

core::ServerInfo info_from_json(const std::string& text) {
  const nlohmann::json j = parse_json(text);
  core::ServerInfo info{j.at("version"), j.at("bodies"), {}, j.at("timestep_s")};
  for (const auto& c : j.at("channels")) {
    info.channels.push_back({c.at("name"), c.at("unit"), c.at("frame")});
  }
  return info;
}

}  // namespace dipper::setup
