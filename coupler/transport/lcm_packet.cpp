#include "coupler/transport/lcm_packet.hpp"

namespace dipper::transport {

std::optional<Packet> read_lcm_packet(std::string_view datagram) {
  constexpr std::size_t kHeader = 8;  // "LC02", and LCM's own count of packets, which says nothing
  constexpr std::size_t kChannel = 63;  // LCM_MAX_CHANNEL_NAME_LENGTH
  if (datagram.size() < kHeader || datagram.substr(0, 4) != "LC02") return std::nullopt;
  datagram.remove_prefix(kHeader);
  const auto end = datagram.substr(0, kChannel + 1).find('\0');
  if (end == std::string_view::npos) return std::nullopt;
  return Packet{std::string(datagram.substr(0, end)), std::string(datagram.substr(end + 1))};
}

}  // namespace dipper::transport
