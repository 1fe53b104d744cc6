#include "coupler/core/protocol.hpp"

#include <gtest/gtest.h>

namespace dipper::core {
namespace {

using Handling = Responder::Handling;

TEST(Protocol, RequestsAreNumberedFromOne) {
  Requester ask;
  EXPECT_EQ(ask.begin(), 1);
  ASSERT_TRUE(ask.accept(1));
  EXPECT_EQ(ask.begin(), 2);
}

TEST(Protocol, ARepeatedRequestIsAnsweredAgainButNotCarriedOutAgain) {
  Responder serve;
  ASSERT_EQ(serve.classify(1), Handling::execute);
  EXPECT_EQ(serve.classify(1), Handling::repeat);
  EXPECT_EQ(serve.classify(2), Handling::execute);
}

TEST(Protocol, AnOldRequestThatComesLateIsIgnored) {
  Responder serve;
  serve.classify(1);
  serve.classify(2);
  EXPECT_EQ(serve.classify(1), Handling::ignore);
}

TEST(Protocol, ASkippedRequestCannotBeServed) {
  Responder serve;
  EXPECT_THROW(serve.classify(2), std::runtime_error);
}

TEST(Protocol, ADuplicateReplyIsTakenOnce) {
  Requester ask;
  ask.begin();
  EXPECT_TRUE(ask.accept(1));
  EXPECT_FALSE(ask.accept(1));
}

TEST(Protocol, OnlyTheReplyToTheCurrentRequestIsTaken) {
  Requester ask;
  ask.begin();
  ask.accept(1);
  ask.begin();
  EXPECT_FALSE(ask.accept(1));
  EXPECT_FALSE(ask.accept(5));
  EXPECT_TRUE(ask.accept(2));
}

/// Asks, again after each of `again` waits in vain; `replies` come before the next request's.
void exchange(Requester& ask, int again, int replies) {
  const std::int64_t number = ask.begin();
  for (int k = 0; k < again; ++k) ask.sent_again();
  for (int k = 0; k < replies; ++k) ask.accept(number);
}

TEST(Protocol, CopiesForASlowAnswerAreNoResends) {
  Requester ask;
  for (int k = 0; k < 100; ++k) exchange(ask, k % 4, 1 + k % 4);
  EXPECT_EQ(ask.resends(), 0);
}

TEST(Protocol, ACopyWhoseReplyComesAfterTheNextRequestIsNoResend) {
  Requester ask;
  exchange(ask, 1, 1);
  ask.begin();
  ask.accept(1);
  ask.accept(2);
  EXPECT_EQ(ask.resends(), 0);
}

TEST(Protocol, WhatIsSentAgainForALostMessageIsCounted) {
  Requester ask;
  exchange(ask, 1, 1);
  exchange(ask, 3, 1);
  exchange(ask, 3, 2);
  exchange(ask, 0, 2);  // doubled on the way
  exchange(ask, 0, 1);
  EXPECT_EQ(ask.resends(), 1 + 3 + 2);
}

}  // namespace
}  // namespace dipper::core
