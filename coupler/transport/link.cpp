#include "coupler/transport/link.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "coupler/transport/codec.hpp"

namespace dipper::transport {

using Clock = std::chrono::steady_clock;

Link::Link(std::string side, Transport& transport, std::string to, std::string from,
           core::Envelope identity, LinkOptions options)
    : side_(std::move(side)),
      transport_(transport),
      to_(std::move(to)),
      from_(std::move(from)),
      requester_(std::move(identity)),
      options_(std::move(options)) {}

core::Body Link::ask(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  const std::string bytes = encode({requester_.begin(step_index, t_ns), std::move(request)});
  transport_.publish(to_, bytes);
  const auto start = Clock::now();
  auto sent = start;
  // Until the other side has answered once it may still be starting: ask often, and count nothing.
  auto patience = established_ ? options_.resend : std::chrono::milliseconds(100);
  while (true) {
    options_.watch();
    const auto packet = transport_.receive(std::min(patience, std::chrono::milliseconds(50)));
    if (packet && packet->channel == from_) {
      try {
        core::Message reply = decode(packet->bytes);
        if (requester_.accept(reply.envelope)) {
          core::require_sound(reply, side_, bodies);
          const auto* status = std::get_if<core::Status>(&reply.body);
          if (status != nullptr && !status->ok) throw PeerError(side_, status->text);
          established_ = true;
          return std::move(reply.body);
        }
      } catch (const DecodeError&) {
        requester_.count_foreign();  // not one of ours: ours are whole
      }
      continue;
    }
    const auto now = Clock::now();
    if (now - start > options_.timeout) {
      throw PeerError(side_, fmt::format("no answer for {} s",
                                         static_cast<double>(options_.timeout.count()) * 1e-3));
    }
    if (now - sent > patience) {
      transport_.publish(to_, bytes);
      sent = now;
      if (!established_) continue;
      requester_.count_resend();
      patience *= 2;  // a long window is no loss
    }
  }
}

void Link::tell(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  transport_.publish(to_, encode({requester_.begin(step_index, t_ns), std::move(request)}));
}

}  // namespace dipper::transport
