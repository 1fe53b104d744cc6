#include "coupler/core/protocol.hpp"

#include <gtest/gtest.h>

namespace dipper::core {
namespace {

Envelope identity() { return {"run", "case", 0, 0, 0}; }

using Handling = Responder::Handling;

TEST(Protocol, EveryRequestIsNumberedAndCarriesTheStepAndTime) {
  Requester ask(identity());
  const Envelope first = ask.begin(0, 10);
  EXPECT_EQ(first.sequence, 1);
  ASSERT_TRUE(ask.accept(first));
  const Envelope second = ask.begin(7, 20);
  EXPECT_EQ(second.sequence, 2);
  EXPECT_EQ(second.step_index, 7);
  EXPECT_EQ(second.t_ns, 20);
  EXPECT_EQ(second.run_id, "run");
}

TEST(Protocol, ARepeatedRequestIsAnsweredAgainButNotCarriedOutAgain) {
  Requester ask(identity());
  Responder serve(identity());
  const Envelope request = ask.begin(0, 0);
  ASSERT_EQ(serve.classify(request), Handling::execute);
  serve.remember("the reply");
  EXPECT_EQ(serve.classify(request), Handling::repeat);
  EXPECT_EQ(serve.reply(), "the reply");
  EXPECT_EQ(serve.counts().repeated, 1);
}

TEST(Protocol, AnOldRequestThatComesLateIsIgnored) {
  Requester ask(identity());
  Responder serve(identity());
  const Envelope first = ask.begin(0, 0);
  serve.classify(first);
  ask.accept(first);
  serve.classify(ask.begin(1, 1));
  EXPECT_EQ(serve.classify(first), Handling::ignore);
}

TEST(Protocol, ADuplicateReplyIsTakenOnce) {
  Requester ask(identity());
  const Envelope reply = ask.begin(0, 0);
  EXPECT_TRUE(ask.accept(reply));
  EXPECT_FALSE(ask.accept(reply));
  EXPECT_EQ(ask.counts().repeated, 1);
}

TEST(Protocol, AnEarlierReplyIsNotTakenForTheCurrentOne) {
  Requester ask(identity());
  const Envelope first = ask.begin(0, 0);
  ask.accept(first);
  ask.begin(1, 1);
  EXPECT_FALSE(ask.accept(first));
}

/// Asks once; `replies` come. How often the request went out at once.
int asked(Requester& ask, int replies, bool again = false) {
  const Envelope request = ask.begin(0, 0);
  const int copies = ask.copies();
  if (again) ask.count_resend();
  for (int k = 0; k < replies; ++k) ask.accept(request);
  return copies;
}

TEST(Protocol, OnANetworkThatLosesNothingEveryMessageGoesOutOnce) {
  Requester ask(identity());
  for (int k = 0; k < 100; ++k) {
    EXPECT_EQ(asked(ask, 1), 1);
    EXPECT_EQ(asked(ask, 2, true), 1);  // slow, not lost
  }
}

TEST(Protocol, AfterALossRequestsGoOutInCopiesForAsLongAsRepliesAreMissing) {
  Requester ask(identity());
  asked(ask, 1, true);  // sent twice, one reply
  asked(ask, 1);        // by then it is known
  for (int k = 0; k < 200; ++k) EXPECT_EQ(asked(ask, kCopies - 1), kCopies);
  int more = 0;
  while (asked(ask, kCopies) > 1) ASSERT_LT(++more, 100);
  EXPECT_GT(more, 30);
  EXPECT_EQ(asked(ask, 1), 1);
}

TEST(Protocol, RepliesGoOutInCopiesForAWhileAfterARequestCameMoreThanOnce) {
  Requester ask(identity());
  Responder serve(identity());
  const auto carried_out = [&](int times) {
    const Envelope request = ask.begin(0, 0);
    for (int k = 0; k < times; ++k) serve.classify(request);
    ask.accept(request);
    return serve.copies();
  };
  EXPECT_EQ(carried_out(1), 1);
  EXPECT_EQ(carried_out(2), kCopies);
  int more = 0;
  while (carried_out(1) > 1) ASSERT_LT(++more, 20);
  EXPECT_GT(more, 4);
}

TEST(Patience, FollowsTheAnswers) {
  Patience quick, slow, varied;
  for (int k = 0; k < 200; ++k) {
    quick.answered(1e-4, false);
    slow.answered(0.1, false);
    varied.answered(k % 2 == 0 ? 0.02 : 0.1, false);
  }
  EXPECT_EQ(quick.s(), 0.01);
  EXPECT_NEAR(slow.s(), 0.1, 1e-3);
  EXPECT_GT(varied.s(), 0.1);
}

TEST(Patience, DoublesInVainUntilAnAnswerToASingleRequest) {
  Patience p;
  for (int k = 0; k < 200; ++k) p.answered(0.02, false);
  const double usual = p.s();
  p.in_vain();
  EXPECT_DOUBLE_EQ(p.s(), 2 * usual);
  p.answered(0.5, true);
  EXPECT_DOUBLE_EQ(p.s(), 2 * usual);
  for (int k = 0; k < 100; ++k) p.in_vain();
  EXPECT_EQ(p.s(), 1.0);
  p.answered(0.02, false);
  EXPECT_NEAR(p.s(), usual, 1e-3);
}

TEST(Protocol, OurSealOnAnotherCaseIsAMixUp) {
  Responder serve(identity());
  Envelope request = identity();
  request.sequence = 1;
  request.case_hash = "other case";
  EXPECT_THROW(serve.classify(request), ProtocolError);
}

TEST(Protocol, ASkippedRequestCannotBeServed) {
  Responder serve(identity());
  Envelope request = identity();
  request.sequence = 2;
  EXPECT_THROW(serve.classify(request), ProtocolError);
}

TEST(Protocol, AReplyToARequestNeverMadeIsAnError) {
  Requester ask(identity());
  Envelope reply = ask.begin(0, 0);
  reply.sequence = 5;
  EXPECT_THROW(ask.accept(reply), ProtocolError);
}

}  // namespace
}  // namespace dipper::core
