#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "coupler/core/message.hpp"
#include "coupler/core/protocol.hpp"
#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// One of the two sides failed. `side` is "dem" or "mbs"; what() is its own message.
struct PeerError : std::runtime_error {
  PeerError(std::string failed_side, const std::string& message)
      : std::runtime_error(message), side(std::move(failed_side)) {}
  std::string side;
};

/// How long to wait, and what to watch while waiting.
struct LinkOptions {
  std::chrono::milliseconds timeout{60000};
  /// For the first answer: a process needs time to start; `watch` notices one that ends.
  std::chrono::milliseconds start{300000};
  /// Time for which the other side has waited for a CPU core since it started; it does not count.
  std::function<std::chrono::duration<double>()> starved = [] { return std::chrono::seconds(0); };
  /// Called at least every 50 ms while waiting; throws when waiting is pointless (a process ended,
  /// the user wants to stop).
  std::function<void()> watch = [] {};
  /// Whether the user wants an orderly end. The other side then has `patience` for each answer, so
  /// that a side that hangs does not delay the end by the whole timeout.
  std::function<bool()> wants_end = [] { return false; };
  std::chrono::milliseconds patience{10000};
  /// Called with every message, in both directions.
  std::function<void(const Packet&)> record = [](const Packet&) {};
};

/// The client of one side. Without a reply it sends again after 10 ms, then after twice as long
/// each time, up to 1 s; up to 100 ms until the first reply, since the other side may still be
/// starting.
class Link {
 public:
  /// `transport` receives from the other side, which listens on the channel `to`.
  Link(std::string side, Transport& transport, std::string to, core::Envelope identity,
       LinkOptions options);

  /// Sends a request. The previous request must have its reply.
  void send(core::Body request, std::int64_t step_index, std::int64_t t_ns);
  /// Waits for the reply. Throws PeerError when the other side reports a failure, or sends nothing
  /// until the timeout, which begins with this call.
  core::Body receive();
  /// Both.
  core::Body ask(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
    send(std::move(request), step_index, t_ns);
    return receive();
  }

  /// Sends the last request, without waiting for a reply: after "stop" the other side exits. May be
  /// called repeatedly.
  void tell(core::Body request, std::int64_t step_index, std::int64_t t_ns);

  const std::string& side() const { return side_; }
  std::int64_t resends() const { return requester_.resends(); }
  std::int64_t foreign() const { return transport_.foreign(); }
  /// Names of the bodies, for messages; known after the other side's first reply.
  std::vector<std::string> bodies;

 private:
  void publish();
  std::optional<core::Body> wait(std::chrono::steady_clock::time_point until);
  /// The awaited reply, if the packet is that.
  std::optional<core::Body> take(const Packet& packet);

  std::string side_;
  Transport& transport_;
  core::Envelope envelope_;
  LinkOptions options_;
  core::Requester requester_;
  Packet request_;            ///< the last one, on the other side's channel
  bool established_ = false;  ///< the other side has replied once
  bool told_ = false;
};

}  // namespace dipper::transport
