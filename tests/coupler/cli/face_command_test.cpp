#include "coupler/cli/face_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/analysis/dump_files.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

using testing::HasSubstr;

/// Frames at 10, 11 and 12 s.
class FaceCommand : public testing::Test {
 protected:
  FaceCommand() {
    s.write("case.txt", "dem.timestep_s=0.01\n");
    for (const long step : {1000, 1100, 1200})
      s.write("dumps/rocks_" + std::to_string(step) + ".dump",
              analysis::text_frame(step, 1, "id x y z radius mass", "1 5 0 1 0.5 1000\n"));
  }

  int ask(std::vector<std::string> words) {
    CLI::App app;
    reporter = {};
    const Command command = add_face_command(app, reporter);
    words.insert(words.begin(), {"face", s.folder().string()});
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return command.run();
  }

  const analysis::Scratch s;
  test::MemoryReporter reporter;
};

TEST_F(FaceCommand, TakesTheNearestFrame) {
  EXPECT_EQ(ask({}), 0);
  EXPECT_THAT(reporter.lines, HasSubstr(" at 12.00 s"));
  EXPECT_EQ(ask({"--at", "11.2"}), 0);
  EXPECT_THAT(reporter.lines, HasSubstr(" at 11.00 s"));
  EXPECT_EQ(ask({"--at", "12.9"}), 0) << "less than one interval after the last";
}

TEST_F(FaceCommand, RefusesATimeFarFromEveryFrame) {
  for (const char* at : {"8.5", "46"}) {
    EXPECT_EQ(ask({"--at", at}), 2) << at;
    EXPECT_EQ(reporter.lines, "");
    EXPECT_THAT(reporter.errors, HasSubstr("--at: there is no frame near " + std::string(at) +
                                           " s; 3 are from 10.00 to 12.00 s"));
  }
}

}  // namespace
}  // namespace dipper::cli
