#include "coupler/core/protocol.hpp"

#include <gtest/gtest.h>

namespace dipper::core {
namespace {

Envelope identity() { return {"run", "case", 0, 0, 0}; }

using Verdict = Responder::Verdict;

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
  ASSERT_EQ(serve.judge(request), Verdict::execute);
  serve.remember("the reply");
  EXPECT_EQ(serve.judge(request), Verdict::repeat);
  EXPECT_EQ(serve.reply(), "the reply");
  EXPECT_EQ(serve.counts().repeated, 1);
}

TEST(Protocol, AnOldRequestThatComesLateIsIgnored) {
  Requester ask(identity());
  Responder serve(identity());
  const Envelope first = ask.begin(0, 0);
  serve.judge(first);
  ask.accept(first);
  serve.judge(ask.begin(1, 1));
  EXPECT_EQ(serve.judge(first), Verdict::ignore);
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

TEST(Protocol, OurSealOnAnotherCaseIsAMixUp) {
  Responder serve(identity());
  Envelope request = identity();
  request.sequence = 1;
  request.case_hash = "other case";
  EXPECT_THROW(serve.judge(request), ProtocolError);
}

TEST(Protocol, ASkippedRequestCannotBeServed) {
  Responder serve(identity());
  Envelope request = identity();
  request.sequence = 2;
  EXPECT_THROW(serve.judge(request), ProtocolError);
}

TEST(Protocol, AReplyToARequestNeverMadeIsAnError) {
  Requester ask(identity());
  Envelope reply = ask.begin(0, 0);
  reply.sequence = 5;
  EXPECT_THROW(ask.accept(reply), ProtocolError);
}

}  // namespace
}  // namespace dipper::core
