#include "coupler/transport/lcm_transport.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "coupler/transport/lcm_packet.hpp"

namespace dipper::transport {
namespace {

using Clock = std::chrono::steady_clock;

/// A socket that hears the URL's group, besides all others that do: lcm-logger, another run.
int listen(const std::string& url) {
  char group[16] = {};
  unsigned short port = 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  if (std::sscanf(url.c_str(), "udpm://%15[0-9.]:%hu", group, &port) != 2 ||
      inet_pton(AF_INET, group, &address.sin_addr) != 1) {
    throw std::runtime_error("not the URL of a multicast group: " + url);
  }
  address.sin_port = htons(port);
  const int s = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  const ip_mreq membership{address.sin_addr, {INADDR_ANY}};
  // Bound to the group, not to any address: what is sent to this host alone does not come in.
  if (s < 0 || setsockopt(s, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      bind(s, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      setsockopt(s, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) {
    const std::string why = std::strerror(errno);
    if (s >= 0) close(s);
    throw std::runtime_error("cannot listen on " + url + ": " + why);
  }
  return s;
}

timespec until(Clock::time_point deadline) {
  const auto left = std::max(Clock::duration::zero(), deadline - Clock::now());
  const auto s = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {s.count(), std::chrono::nanoseconds(left - s).count()};
}

}  // namespace

LcmTransport::LcmTransport(const std::string& url, const std::set<std::string>& channels)
    : lcm_(url), channels_(channels), buffer_(1 << 16) {
  if (!lcm_.good()) {
    throw std::runtime_error("LCM cannot open " + url +
                             ": no multicast route. As root, once: `"
                             "ip route add 239.255.76.0/24 dev lo`");
  }
  socket_ = listen(url);
}

LcmTransport::~LcmTransport() { close(socket_); }

void LcmTransport::publish(const std::string& channel, const std::string& bytes) {
  if (channel.size() + 1 + bytes.size() > kLcmPacketBytes) {
    throw std::runtime_error(
        fmt::format("a message of {} bytes on {} does not fit one packet of "
                    "{}",
                    bytes.size(), channel, kLcmPacketBytes));
  }
  if (lcm_.publish(channel, bytes.data(), static_cast<unsigned>(bytes.size())) != 0) {
    throw std::runtime_error("LCM cannot send on " + channel);
  }
}

std::optional<Packet> LcmTransport::receive(std::chrono::microseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  for (int dropped = 0; dropped < kDropsPerLook || Clock::now() < deadline; ++dropped) {
    const ssize_t n = recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (n >= 0) {
      auto packet = read_lcm_packet({buffer_.data(), static_cast<std::size_t>(n)});
      if (packet && channels_.count(packet->channel) > 0) return packet;
      if (!packet) ++foreign_;
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) {
      throw std::runtime_error(std::string("LCM cannot receive: ") + std::strerror(errno));
    }
    pollfd wait{socket_, POLLIN, 0};
    const timespec left = until(deadline);
    // A signal, Ctrl-C say, cuts the wait short.
    if (ppoll(&wait, 1, &left, nullptr) <= 0) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace dipper::transport
