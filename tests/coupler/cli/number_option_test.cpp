// Every option that is a number refuses what is none, and names its range.
#include "coupler/cli/number_option.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupler/cli/calibrate_command.hpp"
#include "coupler/cli/face_command.hpp"
#include "coupler/cli/report_command.hpp"
#include "coupler/cli/run_command.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What the command line says of the words; "" when it takes them.
std::string refusal(const std::string& words) {
  test::MemoryReporter reporter;
  CLI::App app;
  const std::vector<Command> commands = {
      add_run_command(app, reporter), add_report_command(app, reporter),
      add_face_command(app, reporter), add_calibrate_command(app, reporter)};
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    return e.what();
  }
  return "";
}

struct Option {
  std::string words, name, sound, range;
};

const std::vector<Option> kOptions = {
    {"run case", "--ranks", "2", "whole number, 1 ... 4096"},
    {"run case", "--seed", "7", "whole number, 0 ... 2147483647"},
    {"report run", "--timestep", "1e-4", "number, > 0 and <= 1"},
    {"face run", "--at", "12.5", "number, 0 ... 100000"},
    {"face run", "--heading", "-30", "number, -360 ... 360"},
    {"calibrate pile-angle case", "--target", "34.7", "number, > 0 and < 90"},
    {"calibrate pile-angle case", "--size", "12.2", "number, > 0 and <= 1000"},
    {"calibrate pile-angle case", "--sigma", "2", "number, > 0 and <= 90"},
    {"calibrate pile-angle case", "--seeds", "3", "whole number, 1 ... 1000"},
    {"calibrate pile-angle case", "--seed", "7", "whole number, 0 ... 2147483647"},
    {"calibrate pile-angle case", "--jobs", "2", "whole number, 1 ... 1000"},
    {"calibrate bulk-density case", "--target", "1900", "number, 100 ... 20000"},
};

TEST(NumberOption, NanInfinityAndTextAreRefusedWithTheRange) {
  for (const Option& o : kOptions) {
    const std::string words = o.words + ' ' + o.name + ' ';
    EXPECT_EQ(refusal(words + o.sound), "") << words;
    for (const char* bad : {"nan", "NaN", "inf", "-inf", "1e999", "-1", "much", "0x1p3"}) {
      if (o.name == "--heading" && std::string(bad) == "-1") continue;
      EXPECT_THAT(refusal(words + bad),
                  AllOf(HasSubstr(o.name), HasSubstr(bad), HasSubstr(o.range)))
          << words << bad;
    }
  }
}

}  // namespace
}  // namespace dipper::cli
