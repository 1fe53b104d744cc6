#include "coupler/core/protocol.hpp"

#include <cassert>
#include <utility>

namespace dipper::core {

void require_ours(const Envelope& ours, const Envelope& theirs) {
  if (theirs.run_id != ours.run_id || theirs.case_hash != ours.case_hash) {
    throw ProtocolError("a message carries this run's seal but belongs to run '" + theirs.run_id +
                        "' of case " + theirs.case_hash.substr(0, 12) + ", not to run '" +
                        ours.run_id + "' of case " + ours.case_hash.substr(0, 12));
  }
}

Envelope Requester::begin(std::int64_t step_index, std::int64_t t_ns) {
  assert(!waiting_);
  waiting_ = true;
  unanswered_before_ = std::exchange(unanswered_, 0);
  ++identity_.sequence;
  identity_.step_index = step_index;
  identity_.t_ns = t_ns;
  return identity_;
}

bool Requester::accept(const Envelope& reply) {
  require_ours(identity_, reply);
  if (reply.sequence > identity_.sequence) {
    throw ProtocolError("reply " + std::to_string(reply.sequence) + " to a request never made; " +
                        "the last was " + std::to_string(identity_.sequence));
  }
  const bool of_now = reply.sequence == identity_.sequence;
  if (!waiting_ || !of_now) {
    ++counts_.repeated;
    if (of_now && unanswered_ > 0) --unanswered_;
    if (reply.sequence == identity_.sequence - 1 && unanswered_before_ > 0) --unanswered_before_;
    return false;
  }
  waiting_ = false;
  counts_.resends += std::exchange(unanswered_before_, 0);
  return true;
}

Responder::Handling Responder::classify(const Envelope& request) {
  require_ours(identity_, request);
  if (request.sequence > last_ + 1) {
    throw ProtocolError("request " + std::to_string(request.sequence) + " came after request " +
                        std::to_string(last_) + ": one in between is lost");
  }
  if (request.sequence == last_ + 1) {
    last_ = request.sequence;
    return Handling::execute;
  }
  ++counts_.repeated;
  return request.sequence < last_ ? Handling::ignore : Handling::repeat;
}

}  // namespace dipper::core
