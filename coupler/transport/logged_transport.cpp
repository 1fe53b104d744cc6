#include "coupler/transport/logged_transport.hpp"

#include <stdexcept>

namespace dipper::transport {

void LoggedTransport::publish(const std::string& channel, const std::string& bytes) {
  write(channel, bytes);
  transport_->publish(channel, bytes);
}

std::optional<Packet> LoggedTransport::receive(std::chrono::microseconds timeout) {
  auto packet = transport_->receive(timeout);
  if (packet) write(packet->channel, packet->bytes);
  return packet;
}

void LoggedTransport::write(const std::string& channel, const std::string& bytes) {
  lcm::LogEvent event;
  event.channel = channel;
  event.timestamp = std::chrono::duration_cast<std::chrono::microseconds>(
                        std::chrono::system_clock::now().time_since_epoch())
                        .count();
  std::string copy = bytes;  // LCM's event wants a mutable pointer
  event.data = copy.data();
  event.datalen = static_cast<std::int32_t>(copy.size());
  if (log_->writeEvent(&event) != 0) throw std::runtime_error("cannot write the LCM log");
}

}  // namespace dipper::transport
