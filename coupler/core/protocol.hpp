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
  std::int64_t resends = 0;   ///< requests sent again because no reply came in time
  std::int64_t repeated = 0;  ///< requests or replies that had been dealt with already
  std::int64_t foreign = 0;   ///< packets that are no message of this run; the transport's count
};

/// Strangers do not come this far: the transport passes on what carries the run's seal only. Throws
/// ProtocolError when the seal is ours but the run or the case is not: a mix-up.
void require_ours(const Envelope& ours, const Envelope& theirs);

/// On a network that is seen to lose packets every message goes out this often at once: of three, a
/// network that loses a third lets one through 97 times in a hundred.
inline constexpr int kCopies = 3;

/// How long to wait for an answer before the request goes out again [s]: the smoothed time of
/// answers and four times its mean deviation (Jacobson 1988; RFC 6298), twice that after each wait
/// that was in vain. At least 10 ms, in which a scheduler comes round; at most 1 s.
class Patience {
 public:
  double s() const;

  /// An answer came after that time. Of which of several requests it is the answer nobody knows:
  /// then the time does not count (Karn's rule), and the wait stays as long as it got.
  void answered(double after_s, bool asked_again);
  void in_vain() { factor_ *= 2; }

 private:
  double mean_s_ = 0.02, deviation_s_ = 0.01;
  double factor_ = 1;
};

/// The asking side's end of a link.
class Requester {
 public:
  explicit Requester(Envelope identity) : identity_(std::move(identity)) {}

  /// Numbers a new request. The previous one must have been answered.
  Envelope begin(std::int64_t step_index, std::int64_t t_ns);

  /// The reply awaited? False for replies already taken.
  bool accept(const Envelope& reply);

  /// How often to send the request under way at once.
  int copies() const { return now_.copies; }

  void count_resend();
  const LinkCounts& counts() const { return counts_; }

 private:
  /// A request that went out more than once has as many replies, if nothing is lost.
  struct Tally {
    int copies = 1, replies = 0;
    bool again = false;
    bool shows_loss() const { return replies < (copies > 1 ? copies : again ? 2 : 0); }
  };
  Envelope identity_;
  bool waiting_ = false;
  Tally now_, before_;
  int in_copies_ = 0;  ///< how many more requests go out in copies
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

  /// The request came more than once: so do the next replies go out.
  void heard_copies() { in_copies_ = kRepliesInCopies; }
  /// How often to send a new reply at once.
  int copies() const { return in_copies_ > 0 ? kCopies : 1; }
  const LinkCounts& counts() const { return counts_; }

 private:
  static constexpr int kRepliesInCopies = 8;
  Envelope identity_;
  std::int64_t last_ = 0;
  int in_copies_ = 0;
  std::string reply_;
  LinkCounts counts_;
};

}  // namespace dipper::core
