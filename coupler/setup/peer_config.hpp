#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/core/message.hpp"

namespace dipper::setup {

/// What the launcher tells a side: where to listen, who it is, and the side's own settings. Written
/// to a file that only its owner can read, because of the secret; a command line is for all to see.
struct PeerConfig {
  std::string lcm_url;
  std::string secret;  ///< of this segment of the run; seals its messages
  core::Envelope identity;
  std::filesystem::path checkpoints;  ///< the one folder to save to and load from
  nlohmann::json settings;
};

/// 256 random bits, as hex digits. Throws std::runtime_error when the kernel has none to give.
std::string random_secret();

void write_peer_config(const std::filesystem::path& file, const PeerConfig& config);
/// Throws std::runtime_error naming the file.
PeerConfig read_peer_config(const std::filesystem::path& file);

}  // namespace dipper::setup
