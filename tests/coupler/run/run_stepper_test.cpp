#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "coupler/run/stepper.hpp"
#include "tests/coupler/transport/pair_fakes.hpp"

namespace dipper::run {
namespace {

using testing::ElementsAre;

struct Diary final : Observer {
  explicit Diary(std::string who, std::vector<std::string>& all)
      : name(std::move(who)), pages(all) {}
  void window(const core::Window& w) override {
    pages.push_back(name + std::to_string(w.step_index));
    if (w.step_index == fails_at) throw std::runtime_error("full");
  }
  void end() override { pages.push_back(name + " end"); }
  std::string name;
  std::vector<std::string>& pages;
  std::int64_t fails_at = -1;
};

class Stepping : public testing::Test {
 protected:
  Stepping() {
    stepper.add(first);
    stepper.add(second);
  }
  transport::FakeMachine machine;
  transport::FakeRock rock;
  core::Coupling coupling{machine, rock, core::Scheme::serial};
  Stepper stepper{coupling, 4, 10};
  std::vector<std::string> pages;
  Diary first{"a", pages}, second{"b", pages};
};

TEST_F(Stepping, CallsEveryObserverForEveryWindowAndOfTheEnd) {
  stepper.start();
  EXPECT_TRUE(stepper.run([] { return false; }));
  EXPECT_THAT(pages, ElementsAre("a0", "b0", "a1", "b1", "a2", "b2", "a3", "b3", "a end", "b end"));
  EXPECT_EQ(coupling.state().dem_step, 10);  // the last window is the shorter one
}

TEST_F(Stepping, AfterAnEndWithinAWindowTheNextEndsWhereItWouldHave) {
  stepper.start();
  stepper.run([] { return false; });  // to 10, within the third window
  Stepper longer{coupling, 4, 20};
  longer.run([this] { return coupling.state().dem_step == 12; });
  EXPECT_EQ(coupling.state().dem_step, 12);
}

TEST_F(Stepping, StopsBetweenWindowsAndEndsInOrder) {
  stepper.start();
  EXPECT_FALSE(stepper.run([this] { return coupling.state().step_index == 1; }));
  EXPECT_THAT(pages, ElementsAre("a0", "b0", "a1", "b1", "a end", "b end"));
}

TEST_F(Stepping, EndsWhenTheMachineIsThere) {
  stepper.end_when([](const core::MachineState& m) { return m.t_ns > 0; });
  stepper.start();
  EXPECT_TRUE(stepper.run([] { return false; }));
  EXPECT_THAT(pages, ElementsAre("a0", "b0", "a1", "b1", "a end", "b end"));
}

TEST_F(Stepping, AFailureIsNoEnd) {
  stepper.start();
  first.fails_at = 2;
  EXPECT_THROW(stepper.run([] { return false; }), std::runtime_error);
  EXPECT_THAT(pages, ElementsAre("a0", "b0", "a1", "b1", "a2"));
}

}  // namespace
}  // namespace dipper::run
