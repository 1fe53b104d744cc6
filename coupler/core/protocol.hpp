// Exactly-once requests over a transport that may drop, repeat and reorder.
// Pure: no clock, no I/O. One request is under way at a time; requests are numbered from 1.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <stdexcept>

namespace dipper::core {

/// The client's end.
class Requester {
 public:
  /// The number of a new request. The previous request must have its reply.
  std::int64_t begin() {
    assert(!waiting_);
    waiting_ = true;
    unanswered_before_ = unanswered_;
    unanswered_ = 1;
    return ++number_;
  }

  /// Records that the current request was sent again.
  void sent_again() { ++unanswered_; }

  /// Whether this number is that of the awaited reply, the first time it comes.
  bool accept(std::int64_t number) {
    if (number == number_) --unanswered_;
    if (number == number_ - 1) --unanswered_before_;
    if (number != number_ || !waiting_) return false;
    waiting_ = false;
    resends_ += std::max(0, unanswered_before_);
    return true;
  }

  /// Requests sent again because a message was lost. When the other side is only slow, each copy
  /// has its reply before the next request has one.
  std::int64_t resends() const { return resends_; }

 private:
  std::int64_t number_ = 0;
  bool waiting_ = false;
  int unanswered_ = 0;         ///< copies of this request minus replies to it
  int unanswered_before_ = 0;  ///< the same for the previous request
  std::int64_t resends_ = 0;
};

/// The server's end.
class Responder {
 public:
  enum class Handling {
    execute,  ///< new: execute it and keep the reply
    repeat,   ///< already executed: send the same reply again
    ignore    ///< older
  };
  /// Throws std::runtime_error when a request was skipped: it can never be served in order.
  Handling classify(std::int64_t number) {
    if (number > last_ + 1) throw std::runtime_error("a request between two is lost");
    if (number <= last_) return number == last_ ? Handling::repeat : Handling::ignore;
    last_ = number;
    return Handling::execute;
  }

 private:
  std::int64_t last_ = 0;
};

}  // namespace dipper::core
