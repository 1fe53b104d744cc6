// A whole coupled run over a network that loses, repeats and swaps messages must be the very run
// that a perfect network gives: every window once, in order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "coupler/transport/codec.hpp"
#include "coupler/transport/remote.hpp"
#include "coupler/transport/serve.hpp"
#include "tests/coupler/core/advance.hpp"
#include "tests/coupler/transport/memory_transport.hpp"
#include "tests/coupler/transport/pair_fakes.hpp"

namespace dipper::transport {
namespace {

using namespace std::chrono_literals;

core::Envelope identity() { return {"run", "case", 0, 0, 0}; }

constexpr const char* kSecret = "the secret";

constexpr const char* kCheckpoints = "/tmp/dipper-no-such-folder";

/// Master in this thread, both sides in threads of their own.
class LossyPair {
 public:
  explicit LossyPair(const Faults& faults) : network_(faults) {
    from_dem_ = connect(Channels::from_dem);
    from_mbs_ = connect(Channels::from_mbs);
    dem_thread_ = answering(Channels::to_dem, Channels::from_dem, [this](const core::Message& m) {
      std::this_thread::sleep_for(rock_takes.load());
      return answer(rock, m);
    });
    mbs_thread_ = answering(Channels::to_mbs, Channels::from_mbs,
                            [this](const core::Message& m) { return answer(machine, m); });
    LinkOptions options;
    options.timeout = 20s;
    dem_link = std::make_unique<Link>("dem", *from_dem_, Channels::to_dem, identity(), options);
    mbs_link = std::make_unique<Link>("mbs", *from_mbs_, Channels::to_mbs, identity(), options);
  }
  ~LossyPair() {
    network_.close();
    dem_thread_.join();
    mbs_thread_.join();
  }
  std::vector<double> run(int windows) {
    RemoteMachine remote_machine(*mbs_link);
    RemoteRock remote_rock(*dem_link);
    core::Coupling coupling(remote_machine, remote_rock, core::Scheme::corrected);
    coupling.start();
    std::vector<double> x;
    for (int i = 0; i < windows; ++i) {
      x.push_back(advance(coupling, 5).machine.bodies[0].X_WB.p.x());
    }
    return x;
  }

  FakeMachine machine;
  FakeRock rock;
  std::atomic<std::chrono::milliseconds> rock_takes{0ms};
  std::unique_ptr<Link> dem_link, mbs_link;
  MemoryNetwork& network() { return network_; }

 private:
  std::unique_ptr<Transport> connect(const char* channel) {
    return network_.connect({channel}, kSecret);
  }
  std::thread answering(const char* in, const char* out,
                        const std::function<core::Body(const core::Message&)>& handle) {
    return std::thread([t = std::shared_ptr<Transport>(connect(in)), out, handle] {
      try {
        serve(*t, out, kCheckpoints, handle);
      } catch (const std::exception&) {  // sent to the master as a status; or the network is closed
      }
    });
  }
  MemoryNetwork network_;
  std::unique_ptr<Transport> from_dem_, from_mbs_;
  std::thread dem_thread_, mbs_thread_;
};

std::vector<double> reference(int windows) {
  FakeMachine machine;
  FakeRock rock;
  core::Coupling coupling(machine, rock, core::Scheme::corrected);
  coupling.start();
  std::vector<double> x;
  for (int i = 0; i < windows; ++i) {
    x.push_back(advance(coupling, 5).machine.bodies[0].X_WB.p.x());
  }
  return x;
}

TEST(LossyLink, APerfectNetworkNeedsNoResend) {
  LossyPair pair({});
  EXPECT_EQ(pair.run(50), reference(50));
  EXPECT_EQ(pair.dem_link->foreign(), 0);
  EXPECT_EQ(pair.dem_link->resends() + pair.mbs_link->resends(), 0);
}

TEST(LossyLink, ASlowAnswerIsNoLoss) {
  LossyPair pair({});
  auto tap = pair.network().connect({Channels::to_dem});
  pair.rock_takes = 100ms;
  EXPECT_EQ(pair.run(10), reference(10));
  EXPECT_EQ(pair.rock.windows, 10);
  EXPECT_EQ(pair.dem_link->resends(), 0);
  int asked = 0;
  while (tap->receive(0us)) ++asked;
  EXPECT_GT(asked, 20);  // 12 requests
}

TEST(LossyLink, TheMachineAnswersWhileTheRockComputes) {
  LossyPair pair({});
  RemoteMachine machine(*pair.mbs_link);
  RemoteRock rock(*pair.dem_link);
  pair.rock_takes = 20ms;
  pair.dem_link->send(core::Command{core::Action::hash, ""}, 0, 0);
  EXPECT_EQ(machine.state(0).bodies.size(), 1u);
  EXPECT_EQ(std::get<core::Status>(pair.dem_link->receive()).text, "hash");
}

TEST(LossyLink, DropsDuplicatesAndSwapsChangeNothing) {
  constexpr int kWindows = 30;
  for (const unsigned seed : {1u, 2u, 3u}) {
    LossyPair pair({0.1, 0.2, 0.2, seed});
    EXPECT_EQ(pair.run(kWindows), reference(kWindows)) << "seed " << seed;
    EXPECT_EQ(pair.rock.windows, kWindows);
    EXPECT_EQ(pair.machine.steps, kWindows);
    EXPECT_GT(pair.dem_link->resends(), 0);
  }
}

TEST(LossyLink, StrangersAndGarbageAreCountedAndIgnored) {
  LossyPair pair({});
  auto stranger = pair.network().connect({});
  const auto other = pair.network().connect({}, "another run's secret");
  for (int i = 0; i < 20; ++i) {
    other->publish(Channels::from_dem, encode({identity(), core::Status{true, "{}"}}));
    other->publish(Channels::to_dem, encode({identity(), core::Command{core::Action::stop, ""}}));
    stranger->publish(Channels::from_dem, "not a message at all");
  }
  EXPECT_EQ(pair.run(20), reference(20));
  EXPECT_EQ(pair.dem_link->foreign(), 40);
}

TEST(LossyLink, WhatIsHeardOnTheWireOpensNothingWhenPlayedAgain) {
  LossyPair pair({});
  auto tap = pair.network().connect({Channels::to_dem, Channels::from_dem, Channels::to_mbs});
  pair.run(20);
  std::vector<Packet> heard;
  while (auto packet = tap->receive(0us)) heard.push_back(*packet);
  ASSERT_GT(heard.size(), 60u);
  const int windows = pair.rock.windows, commits = pair.machine.steps;
  for (const Packet& packet : heard) tap->publish(packet.channel, packet.bytes);
  for (const Packet& packet : heard)
    tap->publish(Channels::from_dem, packet.bytes);  // turned round
  RemoteRock rock(*pair.dem_link);
  EXPECT_EQ(rock.info().bodies, pair.rock.info().bodies);
  EXPECT_EQ(pair.rock.windows, windows);
  EXPECT_EQ(pair.machine.steps, commits);
  EXPECT_GT(pair.dem_link->foreign(), 0);
}

TEST(LossyLink, FilesOutsideTheCheckpointsAreRefused) {
  for (const char* file : {"/tmp/elsewhere", "/tmp/dipper-no-such-folder/../elsewhere",
                           "/tmp/dipper-no-such-folder-2/rock.restart"}) {
    LossyPair pair({});
    RemoteRock rock(*pair.dem_link);
    EXPECT_THAT([&] { rock.save(file); },
                testing::ThrowsMessage<PeerError>(testing::HasSubstr("refused to save")))
        << file;
  }
  LossyPair pair({});
  RemoteRock rock(*pair.dem_link);
  rock.save("/tmp/dipper-no-such-folder/000000600.part/rock.restart");
}

/// Hears nothing it waits for, but always something: an old reply, played again.
class Flood final : public Transport {
 public:
  void publish(const std::string&, const std::string&) override {}
  std::optional<Packet> receive(std::chrono::microseconds) override {
    return Packet{Channels::from_dem, old_};
  }
  std::int64_t foreign() const override { return 0; }

 private:
  std::string old_ = encode({identity(), core::Status{}});
};

TEST(LossyLink, AFloodDoesNotPutOffTheTimeout) {
  Flood flooded;
  LinkOptions options;
  options.timeout = options.start = 500ms;
  Link link("dem", flooded, Channels::to_dem, identity(), options);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_THROW(link.ask(core::Command{core::Action::hello, ""}, 0, 0), PeerError);
  EXPECT_LT(std::chrono::steady_clock::now() - began, 1500ms);
}

TEST(LossyLink, ANaNStopsTheRunNamingSideStepAndBody) {
  LossyPair pair({});
  pair.rock.sick_from = 15;
  try {
    pair.run(10);
    FAIL() << "a NaN went through";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::AllOf(testing::HasSubstr("dem"), testing::HasSubstr("'body'"),
                                         testing::HasSubstr("sync step 2")));
  }
}

TEST(LossyLink, ASideThatThrowsIsHeardWithItsOwnWords) {
  LossyPair pair({});
  RemoteRock rock(*pair.dem_link);
  try {
    pair.dem_link->ask(core::MachineStep{}, 0, 0);  // a rock takes no wrenches
    FAIL();
  } catch (const PeerError& e) {
    EXPECT_EQ(e.side, "dem");
    EXPECT_THAT(e.what(), testing::HasSubstr("steps and commands only"));
  }
}

TEST(LossyLink, ASideThatWaitsForACoreIsWaitedFor) {
  MemoryNetwork network;
  auto alone = network.connect({Channels::from_dem});
  const auto began = std::chrono::steady_clock::now();
  LinkOptions options;
  options.timeout = options.start = 1000ms;
  options.starved = [&]() -> std::chrono::duration<double> {  // half of the time, for 2 s
    return std::min<std::chrono::duration<double>>(std::chrono::steady_clock::now() - began, 2s) /
           2;
  };
  options.watch = [&] {
    if (std::chrono::steady_clock::now() - began > 10s) throw std::runtime_error("never ends");
  };
  Link link("dem", *alone, Channels::to_dem, identity(), options);
  EXPECT_THROW(link.ask(core::Command{core::Action::hello, ""}, 0, 0), PeerError);
  EXPECT_GT(std::chrono::steady_clock::now() - began, 1500ms);
  EXPECT_LT(std::chrono::steady_clock::now() - began, 4500ms);
}

TEST(LossyLink, SilenceEndsInATimeout) {
  MemoryNetwork network;
  auto alone = network.connect({Channels::from_dem});
  LinkOptions options;
  options.timeout = options.start = 300ms;
  Link link("dem", *alone, Channels::to_dem, identity(), options);
  EXPECT_THROW(link.ask(core::Command{core::Action::hello, ""}, 0, 0), PeerError);
}

TEST(LossyLink, ASideThatHangsIsNotWaitedForOnceTheUserWantsAnEnd) {
  MemoryNetwork network;
  auto alone = network.connect({Channels::from_dem});
  const auto began = std::chrono::steady_clock::now();
  LinkOptions options;
  options.wants_end = [&] { return std::chrono::steady_clock::now() - began > 200ms; };
  options.patience = 300ms;
  Link link("dem", *alone, Channels::to_dem, identity(), options);
  try {
    link.ask(core::Command{core::Action::hello, ""}, 0, 0);
    FAIL() << "nobody answers";
  } catch (const PeerError& e) {
    EXPECT_EQ(e.side, "dem");
    EXPECT_STREQ(e.what(), "no answer for 0.3 s after the run was asked to end");
  }
  EXPECT_GE(std::chrono::steady_clock::now() - began, 500ms);
  EXPECT_LT(std::chrono::steady_clock::now() - began, 20s) << "and not the 5 min of a first answer";
}

TEST(Answer, OnlyTheMachineLoads) {
  FakeMachine machine;
  FakeRock rock;
  const core::Message load{identity(), core::Command{core::Action::load, "checkpoint"}};
  EXPECT_TRUE(std::get<core::Status>(answer(machine, load)).ok);
  EXPECT_THROW(answer(rock, load), std::runtime_error);
}

}  // namespace
}  // namespace dipper::transport
