// How encoded messages travel. Behind this line: LCM in a run, memory in a test.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace dipper::transport {

/// A message on its way.
struct Packet {
  std::string channel;
  std::string bytes;
};

/// One endpoint, which hears one channel. Delivery is not guaranteed, in neither number nor order.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual void publish(const std::string& channel, const std::string& bytes) = 0;
  /// The next message on the channel, or nothing after `timeout`.
  virtual std::optional<Packet> receive(std::chrono::microseconds timeout) = 0;
  /// How many packets have come that are no message of this run, and were dropped.
  virtual std::int64_t foreign() const = 0;
};

/// Channel names of a run: who is spoken to, who speaks.
struct Channels {
  static constexpr const char* to_dem = "DIPPER_TO_DEM";
  static constexpr const char* from_dem = "DIPPER_FROM_DEM";
  static constexpr const char* to_mbs = "DIPPER_TO_MBS";
  static constexpr const char* from_mbs = "DIPPER_FROM_MBS";
};

}  // namespace dipper::transport
