#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

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
  /// For the first answer of all: on a loaded machine a process takes its time to start, and one
  /// that ends is seen by `watch`.
  std::chrono::milliseconds start{300000};
  /// How long the other side has waited for a core since it started. One that does so for a quarter
  /// of the second before the time-out, and of each second after it, is not hung but on a loaded
  /// machine; it is waited for.
  std::function<std::chrono::duration<double>()> starved = [] {
    return std::chrono::duration<double>(0);
  };
  /// Called at least every 50 ms while waiting; throws when waiting has become pointless
  /// (a process ended, the user wants to stop).
  std::function<void()> watch = [] {};
};

/// The asking end: sends a request until its reply comes, again after 25 ms, then after twice as
/// long each time, up to 1 s.
class Link {
 public:
  /// `transport` hears nothing but `from`: what is left over on it is counted here.
  Link(std::string side, Transport& transport, std::string to, std::string from,
       core::Envelope identity, LinkOptions options);

  /// Throws PeerError when the other side says it failed or says nothing until the timeout.
  core::Body ask(core::Body request, std::int64_t step_index, std::int64_t t_ns);

  /// The two halves of `ask`: the other side works between them.
  void send(core::Body request, std::int64_t step_index, std::int64_t t_ns);
  core::Body receive();

  /// Sends the last request of all, without waiting: after "stop" the other side is gone. Again, as
  /// often as it is called.
  void tell(core::Body request, std::int64_t step_index, std::int64_t t_ns);

  const std::string& side() const { return side_; }
  core::LinkCounts counts() const;
  /// Names for messages about bodies; known once the other side has said hello.
  std::vector<std::string> bodies;

 private:
  /// The reply, if that is what the packet is.
  std::optional<core::Body> reply_in(const Packet& packet);

  std::string side_;
  Transport& transport_;
  std::string to_, from_;
  core::Requester requester_;
  LinkOptions options_;
  bool established_ = false;  ///< the other side has answered once
  bool told_ = false;
  std::string request_;  ///< the last one
  std::chrono::steady_clock::time_point sent_;
};

}  // namespace dipper::transport
