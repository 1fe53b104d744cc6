#include "coupler/cli/completion_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two commands of a program.
struct Program {
  Program() {
    auto* run = app.add_subcommand("run", "runs a case");
    run->add_option("CASE", text, "a folder");
    run->footer("Digs. Example:\n  dipper run pit --ranks 2");
    run->add_option("--ranks", number, "MPI ranks");
    run->add_option("--resume-at", number, ".hidden line");
    app.add_subcommand("report", "makes a page");
    app.add_subcommand("record", "what programs call")->group("");
    auto* calibrate = app.add_subcommand("calibrate", "finds a value");
    for (const char* what : {"angle", "density"})
      calibrate->add_subcommand(what, "of the pile")->add_option("--seeds", number, "runs");
    app.add_subcommand("help", "shows a command");
  }
  CLI::App app{"what it is for", "dipper"};
  std::string text;
  int number = 0;
};

/// What bash offers for a line whose last word is being typed.
std::string offered(const std::string& script, const std::string& words, int last) {
  const std::string command = "bash -c '" + script + "\nCOMP_WORDS=(" + words +
                              "); COMP_CWORD=" + std::to_string(last) +
                              "; _dipper; echo ${COMPREPLY[@]}'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 200> line{};
  return fgets(line.data(), line.size(), pipe.get()) != nullptr ? line.data() : "";
}

TEST(Completion, BashOffersCommandsAndTheirOptions) {
  const Program program;
  const std::string script = bash_completion(program.app);
  EXPECT_EQ(offered(script, "dipper r", 1), "run report\n");
  EXPECT_EQ(offered(script, "dipper run --r", 2), "--ranks --resume-at\n");
  EXPECT_EQ(offered(script, "dipper run cases/", 2), "\n") << "files are bash's own";
  EXPECT_EQ(offered(script, "dipper report --r", 2), "\n");
  EXPECT_EQ(offered(script, "dipper help re", 2), "report\n") << "not what programs call";
}

TEST(Completion, BashOffersACommandsOwnCommandsAndTheirOptions) {
  const std::string script = bash_completion(Program().app);
  EXPECT_EQ(offered(script, "dipper calibrate \"\"", 2), "angle density\n");
  EXPECT_EQ(offered(script, "dipper calibrate angle --s", 3), "--seeds\n");
  EXPECT_EQ(offered(script, "dipper calibrate angle cases/quick --s", 4), "--seeds\n");
}

TEST(Completion, TheManualHasEveryCommandAndOption) {
  const Program program;
  const std::string page = manual_page(program.app);
  EXPECT_THAT(page, HasSubstr(".SS dipper run\nruns a case\n"));
  EXPECT_THAT(page, HasSubstr("Digs. Example:\n.PP\n.nf\n    dipper run pit \\-\\-ranks 2\n.fi\n"))
      << "an example has a line of its own";
  EXPECT_THAT(page, HasSubstr(".B CASE\na folder\n"));
  EXPECT_THAT(page, HasSubstr(".B \\-\\-ranks INT\nMPI ranks\n"));
  EXPECT_THAT(page, HasSubstr("\n\\&.hidden line\n")) << "no request of roff's";
  EXPECT_THAT(page, HasSubstr(".SS dipper calibrate angle\nof the pile\n"));
  EXPECT_THAT(page, Not(HasSubstr("what programs call")));
}

TEST(Completion, IsACommand) {
  CLI::App app{"", "dipper"};
  test::MemoryReporter reporter;
  const Command command = add_completion_command(app, reporter);
  app.parse("completion");
  EXPECT_EQ(command.run(), 0);
  EXPECT_THAT(reporter.lines, HasSubstr("complete -o default -F _dipper dipper"));
}

}  // namespace
}  // namespace dipper::cli
