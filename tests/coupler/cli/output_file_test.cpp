// Outputs that would replace an input, or that cannot be written: before anything is computed.
#include "coupler/cli/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/input_error.hpp"
#include "coupler/cli/motion_command.hpp"
#include "coupler/cli/preview_command.hpp"
#include "tests/common/memory_reporter.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::cli {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// What a command says before it ends with status 2.
template <typename Add>
std::string refused(const Add& add, std::vector<std::string> words) {
  CLI::App app;
  test::MemoryReporter reporter;
  const Command command = add(app, reporter);
  app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  try {
    EXPECT_EQ(command.run(), 2);
  } catch (const InputError& e) {  // main reports it
    return e.what();
  }
  return reporter.errors;
}

TEST(OutputFile, IsNoInputByAnyName) {
  const test::Checkout scratch;
  const fs::path input = scratch.file(), link = scratch.root / "link.yaml";
  fs::create_symlink(input, link);
  for (const fs::path& file : {input, link, scratch.folder() / "../quick/case.yaml"})
    EXPECT_THROW(require_output(file, "--out", {input}), InputError) << file;
  require_output(scratch.root / "new.html", "--out", {input});
  require_output("/dev/null", "--out", {input});
  EXPECT_THROW(require_output(scratch.root, "--out", {input}), InputError) << "a folder";
  EXPECT_THROW(require_output(scratch.root / "none/page.html", "--out", {}), InputError);
}

TEST(OutputFile, APreviewDoesNotReplaceItsCase) {
  const test::Checkout scratch;
  const std::string folder = scratch.folder().string(), before = test::read_text(scratch.file());
  const auto preview = [&](const fs::path& out) {
    return refused(add_preview_command, {"preview", folder, "--out", out.string()});
  };
  EXPECT_THAT(preview(scratch.file()), HasSubstr("case.yaml: --out: is an input"));
  EXPECT_THAT(preview(scratch.root / "meshes/dipper.stl"), HasSubstr("is an input"));
  EXPECT_THAT(preview(scratch.root / "none/p.html"), HasSubstr("none: cannot be written into"));
  EXPECT_EQ(test::read_text(scratch.file()), before);
}

TEST(OutputFile, AMotionDoesNotReplaceItsPath) {
  const test::Checkout scratch;
  const fs::path path = scratch.root / "path.csv";
  fs::copy_file(test::source() / "docs/data/path.csv", path);
  const std::string folder = scratch.folder().string(), before = test::read_text(path);
  const auto motion = [&](const std::string& option, const fs::path& out) {
    return refused(add_motion_command, {"motion", folder, path.string(), option, out.string()});
  };
  EXPECT_THAT(motion("--out", path), HasSubstr("path.csv: --out: is an input"));
  EXPECT_THAT(motion("--out", scratch.file()), HasSubstr("case.yaml: --out: is an input"));
  EXPECT_THAT(motion("--page", scratch.folder() / "motion.csv"), HasSubstr("--page: is an input"));
  EXPECT_EQ(test::read_text(path), before);
}

TEST(OutputFile, AMotionDoesNotReplaceASectionOfItsPlan) {
  const test::Checkout scratch;
  for (const char* name : {"plan.yaml", "face_2.csv", "face_3.csv"})
    fs::copy_file(test::source() / "cases/aitik_coarse" / name, scratch.root / name);
  const fs::path section = scratch.root / "face_2.csv";
  const std::string before = test::read_text(section);
  for (const std::string option : {"--out", "--page"})
    EXPECT_THAT(refused(add_motion_command,
                        {"motion", scratch.folder().string(), "--plan",
                         (scratch.root / "plan.yaml").string(), option, section.string()}),
                HasSubstr("face_2.csv: " + option + ": is an input"));
  EXPECT_EQ(test::read_text(section), before);
}

}  // namespace
}  // namespace dipper::cli
