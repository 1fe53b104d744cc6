// Exactly-once requests over a transport that may drop, repeat and reorder.
// Pure: no clock, no I/O. One request is outstanding at a time; requests are numbered from 1.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupler/core/message.hpp"

namespace dipper::core {

struct ProtocolError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What happened on a link that a healthy one does not show.
struct LinkCounts {
  std::int64_t resends = 0;   ///< packets lost: requests sent again that got no reply of their own
  std::int64_t repeated = 0;  ///< requests or replies that had been dealt with already
  std::int64_t foreign = 0;   ///< packets that are no message of this run; the transport's count
};

/// Strangers do not come this far: the transport passes on what carries the run's seal only. Throws
/// ProtocolError when the seal is ours but the run or the case is not: a mix-up.
void require_ours(const Envelope& ours, const Envelope& theirs);

/// The asking side's end of a link.
class Requester {
 public:
  explicit Requester(Envelope identity) : identity_(std::move(identity)) {}

  /// Numbers a new request. The previous one must have been answered.
  Envelope begin(std::int64_t step_index, std::int64_t t_ns);

  /// The reply awaited? False for replies already taken.
  bool accept(const Envelope& reply);

  /// The request under way went out again.
  void count_resend() { ++unanswered_; }
  const LinkCounts& counts() const { return counts_; }

 private:
  Envelope identity_;
  bool waiting_ = false;
  // Resends that got no reply yet, of this request and the one before. A slow answer brings one
  // reply for each time the request went out, and all of them before that to the next request.
  std::int64_t unanswered_ = 0, unanswered_before_ = 0;
  LinkCounts counts_;
};

/// The answering side's end of a link.
class Responder {
 public:
  explicit Responder(Envelope identity) : identity_(std::move(identity)) {}

  enum class Handling {
    execute,  ///< new: carry it out, then `remember` the reply
    repeat,   ///< already carried out: send `reply()` again
    ignore    ///< older than what has been carried out
  };
  /// Throws ProtocolError when a request has been skipped: it can never be served in order.
  Handling classify(const Envelope& request);

  void remember(std::string reply) { reply_ = std::move(reply); }
  const std::string& reply() const { return reply_; }

  const LinkCounts& counts() const { return counts_; }

 private:
  Envelope identity_;
  std::int64_t last_ = 0;
  std::string reply_;
  LinkCounts counts_;
};

}  // namespace dipper::core
