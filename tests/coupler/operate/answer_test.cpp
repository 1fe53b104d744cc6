#include "coupler/operate/answer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/places.hpp"

namespace dipper::operate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class AnswerTest : public testing::Test {
 protected:
  Answer read(const std::string& line) const {
    return reader.read(line, 1'100'000'000, 1'200'000'000, sent);
  }
  std::string fault(const std::string& line) const {
    try {
      read(line);
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  }
  static std::string with(const std::string& more, const std::string& hoist = "-4.1") {
    return R"({"hoist_m": )" + hoist + R"(, "crowd_m": 0.5, "swing_rad": 0, "door_rad": 0)" + more +
           "}";
  }
  machine::MachineData machine = machine::load_machine(test::source() / "mbs/bucyrus495.yaml");
  AnswerReader reader{machine, machine.dipper.base_rake};
  machine::Drives sent{-4.0, 0.5, 0, 0};
};

TEST_F(AnswerTest, ARateThatIsNotGivenIsTheMeanOne) {
  const Answer a = read(with(R"(, "crowd_m_s": 0.25)"));
  EXPECT_EQ(a.order.by_ns, 1'200'000'000);
  ASSERT_EQ(a.order.to.size(), 8u);
  EXPECT_THAT(std::vector<double>(a.order.to.begin(), a.order.to.begin() + 4),
              ElementsAre(-4.1, 0.5, 0, 0));
  EXPECT_NEAR(a.order.to[4], -1, 1e-12);
  EXPECT_EQ(a.order.to[5], 0.25);
  EXPECT_FALSE(a.done);
  EXPECT_TRUE(read(with(R"(, "done": true)")).done);
}

TEST_F(AnswerTest, NumbersComeToTheLastBit) {
  for (const double x : {-4.0 - 1.0 / 30, -4.0 - 1e-15, -4.05000000000000071}) {
    EXPECT_EQ(read(with("", fmt::format("{}", x))).order.to[0], x);
    EXPECT_EQ(read(with("", fmt::format("{:.17e}", x))).order.to[0], x);
  }
}

TEST_F(AnswerTest, NamesWhatIsWrong) {
  EXPECT_THAT(fault("hello"), HasSubstr("not a line of JSON: 'hello'"));
  EXPECT_THAT(fault("[1, 2]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(fault("{}"), HasSubstr("hoist_m: missing key"));
  EXPECT_THAT(fault(with("", "null")), HasSubstr("hoist_m: null is not a number"));
  EXPECT_THAT(fault(with("", "NaN")), HasSubstr("not a line of JSON"));
  EXPECT_THAT(fault(with("", "1e999")), HasSubstr("not a line of JSON"));
  EXPECT_THAT(fault(with(R"(, "hoist": 1)")),
              HasSubstr("hoist: unknown key; an answer has hoist_m"));
  EXPECT_THAT(fault(with(R"(, "done": 1)")), HasSubstr("done: 1 is not true or false"));
  EXPECT_THAT(fault(with("", "-12.1")),
              HasSubstr("hoist_m: -12.1 is out of the drive's reach, -12 to 0.5"));
  EXPECT_THAT(fault(with("", "-4.2")),
              HasSubstr("hoist_m: asks for -2 m/s; the drive's limit is 1.8 m/s"));
  EXPECT_THAT(fault(with(R"(, "crowd_m_s": 1.1)")),
              HasSubstr("crowd_m_s: is 1.1 m/s; the drive's limit"));
  sent = {-11.9, -1.7, 0, 0};
  EXPECT_THAT(fault(R"({"hoist_m": -12, "crowd_m": -1.7, "swing_rad": 0, "door_rad": 0})"),
              HasSubstr("hoist_m, crowd_m: no saddle angle"));
}

}  // namespace
}  // namespace dipper::operate
