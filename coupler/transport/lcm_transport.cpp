#include "coupler/transport/lcm_transport.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace dipper::transport {

LcmTransport::LcmTransport(const std::string& url, const std::vector<std::string>& channels)
    : lcm_(url) {
  if (!lcm_.good()) {
    throw std::runtime_error("LCM cannot open " + url +
                             ": no multicast route. As root, once: `"
                             "ip route add 239.255.76.0/24 dev lo`");
  }
  for (const auto& channel : channels) lcm_.subscribe(channel, &LcmTransport::on_message, this);
}

void LcmTransport::publish(const std::string& channel, const std::string& bytes) {
  if (lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size())) != 0) {
    throw std::runtime_error("LCM cannot send on " + channel);
  }
}

std::optional<Packet> LcmTransport::receive(std::chrono::milliseconds timeout) {
  if (inbox_.empty() && lcm_.handleTimeout(static_cast<int>(timeout.count())) < 0 &&
      errno != EINTR) {  // a signal, Ctrl-C say, only cuts the wait short
    throw std::runtime_error(std::string("LCM cannot receive: ") + std::strerror(errno));
  }
  if (inbox_.empty()) return std::nullopt;
  Packet packet = std::move(inbox_.front());
  inbox_.pop();
  return packet;
}

void LcmTransport::on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  inbox_.push({channel, {static_cast<const char*>(buffer->data), buffer->data_size}});
}

}  // namespace dipper::transport
