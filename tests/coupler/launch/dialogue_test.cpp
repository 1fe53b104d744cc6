#include "coupler/launch/dialogue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "common/temporary_folder.hpp"

namespace dipper::launch {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

class DialogueTest : public testing::Test {
 protected:
  void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }
  std::unique_ptr<Dialogue> with(const std::string& script,
                                 milliseconds patience = std::chrono::seconds(20)) {
    return std::make_unique<Dialogue>(std::vector<std::string>{"sh", "-c", script}, log,
                                      folder.path(), patience, [] {});
  }
  template <class Action>
  static std::string fault(const Action& action) {
    try {
      action();
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }
  const TemporaryFolder folder{"dialogue"};
  const std::filesystem::path log = folder.path() / "log";
};

TEST_F(DialogueTest, ALineThereAndOneBack) {
  const auto dialogue = with("echo aside >&2; while read -r line; do echo \"$line\"; done");
  const std::string longer(100'000, 'x');  // than a pipe holds
  for (const std::string& line : {std::string("one"), std::string(), longer}) {
    dialogue->say(line);
    EXPECT_EQ(dialogue->hear(), line);
  }
  EXPECT_TRUE(dialogue->dismiss(std::chrono::seconds(20)));
  std::string said;
  std::getline(std::ifstream(log), said);
  EXPECT_EQ(said, "aside");
}

TEST_F(DialogueTest, LinesThatComeTogetherAreHeardOneByOne) {
  const auto dialogue = with("printf 'a\\nb\\n'; read line; printf 'c'; printf 'd\\n'; sleep 60");
  EXPECT_EQ(dialogue->hear(), "a");
  EXPECT_EQ(dialogue->hear(), "b");
  dialogue->say("");
  EXPECT_EQ(dialogue->hear(), "cd");
}

TEST_F(DialogueTest, ReportsHowTheProgramEnded) {
  EXPECT_THAT(fault([&] { with("echo woe >&2; exit 3")->hear(); }),
              HasSubstr("woe (exit status 3)"));
  EXPECT_THAT(fault([&] {
                const auto gone = with("exec 0<&-; echo; exit 4");
                gone->hear();
                for (int i = 0; i < 1000; ++i) gone->say("to nobody");
                gone->hear();
              }),
              HasSubstr("exit status 4"));
}

TEST_F(DialogueTest, GivesUpOnOneThatIsSilentOrDoesNotRead) {
  EXPECT_EQ(fault([&] { with("sleep 60", milliseconds(200))->hear(); }), "no answer for 0.2 s");
  EXPECT_EQ(fault([&] { with("sleep 60", milliseconds(200))->say(std::string(1 << 20, 'x')); }),
            "does not read its stdin for 0.2 s");
  struct Enough : std::exception {};
  Dialogue watched({"sleep", "60"}, log, folder.path(), std::chrono::minutes(5),
                   [] { throw Enough(); });
  EXPECT_THROW(watched.hear(), Enough);
}

}  // namespace
}  // namespace dipper::launch
