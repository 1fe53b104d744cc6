#include "coupler/setup/peer_config.hpp"

#include <sys/stat.h>

#include <fstream>
#include <stdexcept>

namespace dipper::setup {

using nlohmann::json;

void write_peer_config(const std::filesystem::path& file, const PeerConfig& config) {
  const mode_t old = umask(077);
  std::ofstream out(file);
  umask(old);
  out << json{{"lcm_url", config.lcm_url},
              {"secret", config.secret},
              {"run_id", config.identity.run_id},
              {"case_hash", config.identity.case_hash},
              {"checkpoints", config.checkpoints.string()},
              {"settings", config.settings}}
             .dump(2)
      << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

PeerConfig read_peer_config(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  const json j = json::parse(in);
  PeerConfig c;
  c.lcm_url = j.at("lcm_url");
  c.secret = j.at("secret");
  c.identity.run_id = j.at("run_id");
  c.identity.case_hash = j.at("case_hash");
  c.checkpoints = j.at("checkpoints").get<std::string>();
  c.settings = j.at("settings");
  return c;
}

}  // namespace dipper::setup
