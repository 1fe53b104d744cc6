#include "coupler/transport/link.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "coupler/transport/codec.hpp"

namespace dipper::transport {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr Clock::duration kFirstWait = 25ms;

Link::Link(std::string side, Transport& transport, std::string to, std::string from,
           core::Envelope identity, LinkOptions options)
    : side_(std::move(side)),
      transport_(transport),
      to_(std::move(to)),
      from_(std::move(from)),
      requester_(std::move(identity)),
      options_(std::move(options)) {}

core::LinkCounts Link::counts() const {
  core::LinkCounts counts = requester_.counts();
  counts.foreign = transport_.foreign();
  return counts;
}

core::Body Link::ask(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  send(std::move(request), step_index, t_ns);
  return receive();
}

void Link::send(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  // Nothing that has come can be the answer yet; a queue that is full would lose it.
  const auto enough = Clock::now() + 10ms;
  while (const auto old = transport_.receive(0us)) {
    reply_in(*old);  // counts it
    if (Clock::now() > enough) break;
  }
  request_ = encode({requester_.begin(step_index, t_ns), std::move(request)});
  transport_.publish(to_, request_);
  sent_ = Clock::now();
}

core::Body Link::receive() {
  const auto start = sent_;
  const auto limit = established_ ? options_.timeout : std::max(options_.start, options_.timeout);
  // Until the other side has answered once it may still be starting: that counts as no loss.
  Clock::duration wait = established_ ? kFirstWait : 100ms;
  std::chrono::milliseconds deadline = limit;
  std::optional<std::chrono::duration<double>> starved_before;
  while (true) {
    options_.watch();
    const auto left = std::chrono::duration_cast<std::chrono::microseconds>(sent_ + wait - Clock::now());
    const auto packet = transport_.receive(std::clamp(left, 0us, std::chrono::microseconds(50ms)));
    auto reply = packet ? reply_in(*packet) : std::nullopt;
    if (reply) {
      established_ = true;
      return std::move(*reply);
    }
    const auto now = Clock::now();
    if (!starved_before && now - start > deadline - 1s) starved_before = options_.starved();
    if (now - start > deadline) {
      const auto starved = options_.starved();
      if (starved - *starved_before > 250ms) {
        starved_before = starved;
        deadline += 1s;
        continue;
      }
      throw PeerError(side_,
                      fmt::format("no answer for {} s", static_cast<double>(limit.count()) * 1e-3));
    }
    if (now - sent_ < wait) continue;
    transport_.publish(to_, request_);
    sent_ = now;
    if (!established_) continue;
    requester_.count_resend();
    wait = std::min<Clock::duration>(2 * wait, 1s);
  }
}

std::optional<core::Body> Link::reply_in(const Packet& packet) {
  if (packet.channel != from_) return std::nullopt;
  core::Message reply;
  try {
    reply = decode(packet.bytes);
  } catch (const DecodeError& e) {
    throw PeerError(side_, e.what());  // under our own seal: another version
  }
  if (!requester_.accept(reply.envelope)) return std::nullopt;
  core::require_sound(reply, side_, bodies);
  const auto* status = std::get_if<core::Status>(&reply.body);
  if (status != nullptr && !status->ok) throw PeerError(side_, status->text);
  return std::move(reply.body);
}

void Link::tell(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
  if (!told_) request_ = encode({requester_.begin(step_index, t_ns), std::move(request)});
  told_ = true;
  transport_.publish(to_, request_);
}

}  // namespace dipper::transport
