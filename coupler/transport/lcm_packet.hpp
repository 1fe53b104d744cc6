#pragma once

#include <optional>
#include <string_view>

#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// The largest channel and message, its NUL counted, that LCM sends in one packet [bytes]. Ours
/// never need more, and fragments are not taken: putting strangers' pieces together is how a
/// receiver is led to write where it must not.
inline constexpr std::size_t kLcmPacketBytes = 65499;

/// What a datagram of LCM carries ("LC02", a number, the channel with its NUL, the message), or
/// nothing when it is anything else.
std::optional<Packet> read_lcm_packet(std::string_view datagram);

}  // namespace dipper::transport
