// Who may write a run's folder, and whether what goes on there is the same run.
#include "coupler/result/run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/input_error.hpp"
#include "coupler/run/same_run.hpp"
#include "coupler/run/settings.hpp"
#include "machine/motion.hpp"
#include "tests/coupler/case/checkout.hpp"

namespace dipper::run {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

TEST(RunFolder, HasOneOwnerAtATime) {
  const test::Checkout scratch;
  const fs::path out = scratch.root / "run";
  {
    const result::RunFolder mine = result::RunFolder::create(out);
    EXPECT_TRUE(fs::is_directory(mine.checkpoints()));
    EXPECT_THAT([&] { result::RunFolder::create(out); },
                ThrowsMessage<InputError>(
                    HasSubstr("another run is writing it (process " + std::to_string(getpid()))));
    EXPECT_THAT([&] { result::RunFolder::resume(out); },
                ThrowsMessage<InputError>(HasSubstr("holds no run to resume")));
    test::write_text(mine.record(), "rows");
    EXPECT_THAT([&] { result::RunFolder::resume(out); },
                ThrowsMessage<InputError>(HasSubstr("another run is writing it")));
  }
  EXPECT_THAT([&] { result::RunFolder::create(out); },
              ThrowsMessage<InputError>(HasSubstr("holds a run already")));
  EXPECT_EQ(result::RunFolder::resume(out).root(), out);
  EXPECT_FALSE(fs::exists(out / "run.lock"));
}

TEST(RunFolder, ThatCannotBeMadeIsTheUsersMistake) {
  const test::Checkout scratch;
  test::write_text(scratch.root / "file", "in the way");
  EXPECT_THAT([&] { result::RunFolder::create(scratch.root / "file" / "run"); },
              ThrowsMessage<InputError>(HasSubstr("cannot be written")));
}

TEST(Settings, AreKeptTheLastOfAKey) {
  const test::Checkout scratch;
  EXPECT_TRUE(read_settings(scratch.root).empty());
  write_settings(scratch.root, {{"end_s", "1"}, {"dem.ranks", "2"}, {"end_s", "2.5"}});
  std::vector<std::string> kept;
  for (const cases::Override& o : read_settings(scratch.root))
    kept.push_back(o.key + "=" + o.value);
  EXPECT_THAT(kept, ElementsAre("dem.ranks=2", "end_s=2.5"));
}

TEST(SameRun, NamesTheKeyOrTheFileThatIsNotAsItWas) {
  const test::Checkout checkout;
  const fs::path out = checkout.root / "run";
  fs::create_directory(out);
  const auto load = [&](const std::vector<cases::Override>& set) {
    std::vector<Finding> findings;
    cases::Case c = cases::load_case(checkout.folder(), set, findings);
    EXPECT_TRUE(findings.empty());
    return c;
  };
  write_identity(out, load({}));
  for (const char* kept : {"motion.csv", "machine.yaml"}) EXPECT_TRUE(fs::exists(out / kept));
  EXPECT_THAT(changed_since(out, load({}), 0), IsEmpty());
  EXPECT_THAT(changed_since(out, load({{"end_s", "3"}, {"output.dump_every_s", "1"}}), 0),
              IsEmpty());
  EXPECT_THAT(changed_since(out, load({{"seed", "12345"}}), 0), testing::Contains("seed=12345"));

  for (const char* name : {"mbs/bucyrus495.yaml", "meshes/door.stl", "meshes/dipper.yaml"}) {
    const fs::path file = checkout.root / name;
    const std::string before = test::read_text(file);
    test::write_text(file, before + "\n");
    EXPECT_THAT(changed_since(out, load({}), 0),
                ElementsAre(EndsWith(std::string(name) + " has changed")));
    test::write_text(file, before);
  }

  // The motion may be another one from where the run goes on.
  const fs::path motion = load({}).machine.motion;
  std::string rows = test::read_text(motion);
  const machine::Motion whole = machine::Motion::load(motion);
  const double end_s = 1e-9 * static_cast<double>(whole.end_ns());
  rows += fmt::format("{},-1,0,0,0\n", end_s + 5);
  test::write_text(motion, rows);
  EXPECT_THAT(changed_since(out, load({}), 0.5 * end_s), IsEmpty());
  EXPECT_THAT(changed_since(out, load({}), end_s + 1),
              ElementsAre(HasSubstr("differs before t = ")));
  write_identity(out, load({}));
  EXPECT_THAT(changed_since(out, load({}), end_s + 1), IsEmpty());
  fs::remove(out / "motion.csv");
  test::write_text(motion, rows + "\n");
  EXPECT_THAT(changed_since(out, load({}), 0), ElementsAre(HasSubstr("differs before t")));

  fs::remove(out / "inputs.sha256");
  EXPECT_THAT(changed_since(out, load({}), 0), ElementsAre(HasSubstr("no inputs.sha256")));
}

}  // namespace
}  // namespace dipper::run
