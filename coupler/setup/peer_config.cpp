#include "coupler/setup/peer_config.hpp"

#include <fmt/core.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "common/json_text.hpp"
#include "common/text_file.hpp"

namespace dipper::setup {

using nlohmann::json;

std::string random_secret() {
  std::array<unsigned char, 32> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the kernel gives no random bytes for the run's secret");
  }
  std::string hex;
  for (const auto b : bytes) hex += fmt::format("{:02x}", b);
  return hex;
}

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
  const std::optional<std::string> text = read_bytes(file);
  if (!text) throw std::runtime_error("cannot read " + file.string());
  const json j = parse_json(*text);
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
