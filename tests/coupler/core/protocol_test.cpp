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

/// Asks; the request goes out `again` times more, and `replies` come.
void asked(Requester& ask, int again, int replies) {
  const Envelope request = ask.begin(0, 0);
  for (int k = 0; k < again; ++k) ask.count_resend();
  for (int k = 0; k < replies; ++k) ask.accept(request);
}

TEST(Protocol, ASlowAnswerIsNoLoss) {
  Requester ask(identity());
  asked(ask, 1, 2);
  asked(ask, 3, 4);
  asked(ask, 0, 1);
  EXPECT_EQ(ask.counts().resends, 0);
  EXPECT_EQ(ask.counts().repeated, 4);
}

TEST(Protocol, AReplyToTheRequestBeforeThatComesLateIsNoLossEither) {
  Requester ask(identity());
  const Envelope first = ask.begin(0, 0);
  ask.count_resend();
  ask.accept(first);
  const Envelope second = ask.begin(0, 0);
  ask.accept(first);
  ask.accept(second);
  EXPECT_EQ(ask.counts().resends, 0);
}

TEST(Protocol, AResendWithoutAReplyOfItsOwnIsALoss) {
  Requester ask(identity());
  asked(ask, 2, 1);
  asked(ask, 1, 1);
  EXPECT_EQ(ask.counts().resends, 2) << "known once the next request is answered";
  asked(ask, 0, 1);
  EXPECT_EQ(ask.counts().resends, 3);
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
