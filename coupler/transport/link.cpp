#include "coupler/transport/link.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "coupler/transport/codec.hpp"

namespace dipper::transport {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

Link::Link(std::string side, Transport& transport, std::string to, core::Envelope identity,
           LinkOptions options)
    : side_(std::move(side)),
      transport_(transport),
      envelope_(std::move(identity)),
      options_(std::move(options)),
      request_{std::move(to), ""} {}

void Link::publish() {
  options_.record(request_);
  transport_.publish(request_.channel, request_.bytes);
}

void Link::send(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  // Nothing received so far can be the answer, and in a full queue it would be lost.
  for (int old = 0; old < 1000; ++old) {
    const auto packet = transport_.receive(0us);
    if (!packet) break;
    take(*packet);  // counts it
  }
  envelope_.step_index = step_index;
  envelope_.t_ns = t_ns;
  envelope_.sequence = requester_.begin();
  request_.bytes = encode({envelope_, std::move(request)});
  publish();
}

core::Body Link::receive() {
  const auto start = Clock::now();
  const auto limit = established_ ? options_.timeout : std::max(options_.start, options_.timeout);
  std::chrono::milliseconds interval = 10ms;
  auto reply = wait(start + interval);
  const auto starved = reply ? 0s : options_.starved();
  std::optional<Clock::time_point> wanted;  // time at which the user asked for the end
  auto starved_then = starved;
  while (!reply) {
    if (!wanted && options_.wants_end()) {
      wanted = Clock::now();
      starved_then = options_.starved();
    }
    if (wanted &&
        Clock::now() - *wanted - (options_.starved() - starved_then) >= options_.patience) {
      const std::chrono::duration<double> said = options_.patience;
      throw PeerError(
          side_, fmt::format("no answer for {} s after the run was asked to end", said.count()));
    }
    if (Clock::now() - start - (options_.starved() - starved) >= limit) {
      throw PeerError(side_, fmt::format("no answer for {} s", limit / 1.0s));
    }
    publish();
    if (established_) requester_.sent_again();
    interval = std::min<std::chrono::milliseconds>(2 * interval, established_ ? 1000ms : 100ms);
    reply = wait(Clock::now() + interval);
  }
  established_ = true;
  return std::move(*reply);
}

std::optional<core::Body> Link::wait(Clock::time_point until) {
  std::optional<core::Body> reply;
  do {
    options_.watch();
    const auto left = std::clamp<Clock::duration>(until - Clock::now(), 0ms, 50ms);
    const auto packet =
        transport_.receive(std::chrono::duration_cast<std::chrono::microseconds>(left));
    if (packet) reply = take(*packet);
  } while (!reply && Clock::now() < until);
  return reply;
}

std::optional<core::Body> Link::take(const Packet& packet) {
  options_.record(packet);
  core::Message reply = decode(packet.bytes);
  if (!requester_.accept(reply.envelope.sequence)) return std::nullopt;
  core::require_sound(reply, side_, bodies);
  const auto* status = std::get_if<core::Status>(&reply.body);
  if (status != nullptr && !status->ok) throw PeerError(side_, status->text);
  return std::move(reply.body);
}

void Link::tell(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  if (std::exchange(told_, true)) return publish();
  send(std::move(request), step_index, t_ns);
}

}  // namespace dipper::transport
