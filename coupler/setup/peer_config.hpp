#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "coupler/core/message.hpp"

namespace dipper::setup {

/// The configuration that the launcher gives to a side: where to listen, its identity, and the
/// side's own settings. Written to a file that only its owner can read, because of the secret; any
/// user can read a command line.
struct PeerConfig {
  std::string lcm_url;
  std::string secret;  ///< of this segment of the run; authenticates its messages
  core::Envelope identity;
  std::filesystem::path checkpoints;  ///< the only folder in which it may save and load
  nlohmann::json settings;
};

/// 256 random bits, as hex digits. Throws std::runtime_error when the kernel provides none.
std::string random_secret();

void write_peer_config(const std::filesystem::path& file, const PeerConfig& config);
/// Throws std::runtime_error naming the file.
PeerConfig read_peer_config(const std::filesystem::path& file);

}  // namespace dipper::setup
