#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "coupler/core/message.hpp"
#include "coupler/core/protocol.hpp"
#include "coupler/transport/transport.hpp"

namespace dipper::transport {

/// One side of the pair failed. `side` is "dem" or "mbs"; what() is its own message.
struct PeerError : std::runtime_error {
  PeerError(std::string failed_side, const std::string& message)
      : std::runtime_error(message), side(std::move(failed_side)) {}
  std::string side;
};

/// How long to wait, and what to look after meanwhile.
struct LinkOptions {
  std::chrono::milliseconds timeout{60000};
  /// For the first answer of all: a process takes its time to start; `watch` sees one that ends.
  std::chrono::milliseconds start{300000};
  /// How long the other side has waited for a core since it started: such time does not count.
  std::function<std::chrono::duration<double>()> starved = [] { return std::chrono::seconds(0); };
  /// Called at least every 50 ms while waiting; throws when waiting has become pointless
  /// (a process ended, the user wants to stop).
  std::function<void()> watch = [] {};
  /// Whether the user wants an orderly end. The other side then has `patience` for each answer: one
  /// that hangs is not waited for until the timeout.
  std::function<bool()> wants_end = [] { return false; };
  std::chrono::milliseconds patience{10000};
  /// Is given every message, both ways.
  std::function<void(const Packet&)> record = [](const Packet&) {};
};

/// The asking end. Without a reply it sends again after 10 ms, then after twice as long each time,
/// up to 1 s; up to 100 ms until the first reply: the other side may still be starting.
class Link {
 public:
  /// `transport` hears the other side, which listens on the channel `to`.
  Link(std::string side, Transport& transport, std::string to, core::Envelope identity,
       LinkOptions options);

  /// Sends a request. The reply to the one before must have been received.
  void send(core::Body request, std::int64_t step_index, std::int64_t t_ns);
  /// Waits for its reply. Throws PeerError when the other side says it failed or says nothing until
  /// the timeout, which begins with this call.
  core::Body receive();
  /// Both.
  core::Body ask(core::Body request, std::int64_t step_index, std::int64_t t_ns) {
    send(std::move(request), step_index, t_ns);
    return receive();
  }

  /// Sends the last request of all, without waiting: after "stop" the other side is gone. Again, as
  /// often as it is called.
  void tell(core::Body request, std::int64_t step_index, std::int64_t t_ns);

  const std::string& side() const { return side_; }
  std::int64_t resends() const { return requester_.resends(); }
  std::int64_t foreign() const { return transport_.foreign(); }
  /// Names for messages about bodies; known once the other side has said hello.
  std::vector<std::string> bodies;

 private:
  void publish();
  std::optional<core::Body> wait(std::chrono::steady_clock::time_point until);
  /// The reply awaited, if that is what the packet is.
  std::optional<core::Body> take(const Packet& packet);

  std::string side_;
  Transport& transport_;
  core::Envelope envelope_;
  LinkOptions options_;
  core::Requester requester_;
  Packet request_;            ///< the last one, to the other side's channel
  bool established_ = false;  ///< the other side has answered once
  bool told_ = false;
};

}  // namespace dipper::transport
