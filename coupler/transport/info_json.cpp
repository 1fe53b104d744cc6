#include "coupler/transport/info_json.hpp"

#include <nlohmann/json.hpp>

namespace dipper::transport {

std::string to_json(const core::ServerInfo& info) {
  auto channels = nlohmann::json::array();
  for (const auto& c : info.channels) {
    channels.push_back({{"name", c.name}, {"unit", c.unit}, {"frame", c.frame}});
  }
  return nlohmann::json{{"version", info.version},
                        {"bodies", info.bodies},
                        {"timestep_s", info.timestep_s},
                        {"channels", channels}}
      .dump();
}

core::ServerInfo info_from_json(const std::string& text) {
  const auto j = nlohmann::json::parse(text);
  core::ServerInfo info;
  info.version = j.at("version");
  info.bodies = j.at("bodies").get<std::vector<std::string>>();
  info.timestep_s = j.at("timestep_s");
  for (const auto& c : j.at("channels")) {
    info.channels.push_back({c.at("name"), c.at("unit"), c.at("frame")});
  }
  return info;
}

}  // namespace dipper::transport
