#include "coupler/transport/lcm_transport.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <linux/filter.h>
#include <netinet/udp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "coupler/transport/seal.hpp"

namespace dipper::transport {
namespace {

using Clock = std::chrono::steady_clock;

/// Largest sum of channel, its NUL and message that LCM sends in one packet [bytes].
constexpr std::size_t kLargestPacket = 65499;

/// A call that drops packets checks the clock after this many of them, which takes milliseconds. So
/// even a call without time left empties the queue, and a flood of packets cannot delay it further.
constexpr int kDropsPerLook = 1000;

/// What precedes the channel in a datagram: "LC02", and LCM's own packet counter, which is not
/// used.
constexpr std::size_t kHeader = 8;

/// The kernel drops datagrams of other channels. All processes of a run are in one multicast group;
/// without this each message would wake all of them.
bool drop_other_channels(int s, const std::string& channel) {
  std::vector<sock_filter> program;
  const auto require = [&](std::size_t at, char byte) {  // else the next instruction drops it
    program.push_back(BPF_STMT(BPF_LD | BPF_B | BPF_ABS, static_cast<unsigned>(at)));
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned char>(byte), 1, 0));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, 0));
  };
  const std::size_t first = sizeof(udphdr) + kHeader;  // a filter sees the UDP header too
  for (std::size_t i = 0; i <= channel.size(); ++i) require(first + i, channel.c_str()[i]);
  program.push_back(BPF_STMT(BPF_RET | BPF_K, 0xffffffff));
  const sock_fprog all{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(s, SOL_SOCKET, SO_ATTACH_FILTER, &all, sizeof all) == 0;
}

/// A socket that receives a channel of the URL's multicast group, beside any others on it:
/// lcm-logger, another run.
int listen(const std::string& url, const std::string& channel) {
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
  // Bound to the group, not to any address: unicast packets to this host are not received.
  if (s < 0 || setsockopt(s, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      !drop_other_channels(s, channel) ||
      bind(s, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      setsockopt(s, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0) {
    const std::string why = std::strerror(errno);
    if (s >= 0) close(s);
    throw std::runtime_error("cannot listen on " + url + ": " + why);
  }
  return s;
}

}  // namespace

std::optional<Packet> read_lcm_packet(std::string_view datagram) {
  constexpr std::size_t kChannel = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH
  if (datagram.size() < kHeader || datagram.substr(0, 4) != "LC02") return std::nullopt;
  datagram.remove_prefix(kHeader);
  const auto end = datagram.substr(0, kChannel + 1).find('\0');
  if (end == std::string_view::npos) return std::nullopt;
  return Packet{std::string(datagram.substr(0, end)), std::string(datagram.substr(end + 1))};
}

LcmTransport::LcmTransport(const std::string& url, const std::string& channel, std::string secret)
    : lcm_(url), secret_(std::move(secret)), buffer_(1 << 16) {
  if (!lcm_.good()) {
    throw std::runtime_error("LCM cannot open " + url +
                             ": no multicast route. As root, once: "
                             "`ip route add 239.255.76.0/24 dev lo`");
  }
  socket_ = listen(url, channel);
}

LcmTransport::~LcmTransport() { close(socket_); }

void LcmTransport::publish(const std::string& channel, const std::string& bytes) {
  const std::size_t size = channel.size() + 1 + bytes.size();
  if (size > kLargestPacket) {
    throw std::runtime_error(
        fmt::format("a packet of {} bytes for {}: {} fit one", size, channel, kLargestPacket));
  }
  Packet packet{channel, bytes};
  seal(secret_, packet);
  if (lcm_.publish(channel, packet.bytes.data(), static_cast<unsigned>(bytes.size())) != 0) {
    throw std::runtime_error("LCM cannot send on " + channel);
  }
}

std::optional<Packet> LcmTransport::receive(std::chrono::microseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  for (int dropped = 0; dropped < kDropsPerLook || Clock::now() < deadline; ++dropped) {
    const ssize_t n = recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (n >= 0) {
      auto packet = read_lcm_packet({buffer_.data(), static_cast<std::size_t>(n)});
      if (packet && unseal(secret_, *packet)) return packet;
      ++foreign_;
      continue;
    }
    if (errno != EAGAIN && errno != EINTR) {
      throw std::runtime_error(std::string("LCM cannot receive: ") + std::strerror(errno));
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd wait{socket_, POLLIN, 0};
    // A signal such as Ctrl-C interrupts the wait.
    if (poll(&wait, 1, std::max(0, static_cast<int>(left))) <= 0) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace dipper::transport
