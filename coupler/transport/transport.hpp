// The interface of a transport for encoded messages: LCM in a run, memory in a test.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace dipper::transport {

/// A message with its channel.
struct Packet {
  std::string channel;
  std::string bytes;
};

/// One endpoint, which receives one channel. Packets may be lost, repeated or reordered.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual void publish(const std::string& channel, const std::string& bytes) = 0;
  /// The next message on the channel, or none after `timeout`.
  virtual std::optional<Packet> receive(std::chrono::microseconds timeout) = 0;
  /// Number of packets received that are not messages of this run and were dropped.
  virtual std::int64_t foreign() const = 0;
};

/// Channel names of a run, to and from each side.
struct Channels {
  static constexpr const char* to_dem = "DIPPER_TO_DEM";
  static constexpr const char* from_dem = "DIPPER_FROM_DEM";
  static constexpr const char* to_mbs = "DIPPER_TO_MBS";
  static constexpr const char* from_mbs = "DIPPER_FROM_MBS";
};

}  // namespace dipper::transport
