#include "coupler/core/protocol.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dipper::core {

void require_ours(const Envelope& ours, const Envelope& theirs) {
  if (theirs.run_id != ours.run_id || theirs.case_hash != ours.case_hash) {
    throw ProtocolError("a message carries this run's seal but belongs to run '" + theirs.run_id +
                        "' of case " + theirs.case_hash.substr(0, 12) + ", not to run '" +
                        ours.run_id + "' of case " + ours.case_hash.substr(0, 12));
  }
}

namespace {

constexpr int kRequestsInCopies = 64;  // after each sign of loss

}  // namespace

double Patience::s() const { return std::clamp(factor_ * (mean_s_ + 4 * deviation_s_), 0.01, 1.0); }

void Patience::answered(double after_s, bool asked_again) {
  if (asked_again) return;
  deviation_s_ += (std::abs(after_s - mean_s_) - deviation_s_) / 4;
  mean_s_ += (after_s - mean_s_) / 8;
  factor_ = 1;
}

Envelope Requester::begin(std::int64_t step_index, std::int64_t t_ns) {
  assert(!waiting_);
  waiting_ = true;
  before_ = now_;
  now_ = {in_copies_ > 0 ? kCopies : 1};
  in_copies_ = std::max(0, in_copies_ - 1);
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
  if (of_now) ++now_.replies;
  if (reply.sequence == identity_.sequence - 1) ++before_.replies;
  if (!waiting_ || !of_now) {
    ++counts_.repeated;
    return false;
  }
  waiting_ = false;
  // All replies to the request before have come by now, or are lost. One that came late is no loss.
  if (before_.shows_loss()) in_copies_ = kRequestsInCopies;
  return true;
}

void Requester::count_resend() {
  ++counts_.resends;
  now_.again = true;
}

Responder::Handling Responder::classify(const Envelope& request) {
  require_ours(identity_, request);
  if (request.sequence > last_ + 1) {
    throw ProtocolError("request " + std::to_string(request.sequence) + " came after request " +
                        std::to_string(last_) + ": one in between is lost");
  }
  if (request.sequence == last_ + 1) {
    last_ = request.sequence;
    in_copies_ = std::max(0, in_copies_ - 1);
    return Handling::execute;
  }
  ++counts_.repeated;
  if (request.sequence < last_) return Handling::ignore;
  heard_copies();
  return Handling::repeat;
}

}  // namespace dipper::core
