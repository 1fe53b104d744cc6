#include "common/record/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "common/input_error.hpp"

namespace dipper::record {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class RecordTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("dipper-record-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    file_ = folder_ / "record.h5";
  }
  void TearDown() override { fs::remove_all(folder_); }
  /// A record of a run that ended after so many rows: time_s counts them.
  void write_rows(int rows) const {
    Record r = Record::create(file_, {});
    const auto t = r.add("time_s", "s", "-");
    for (int i = 0; i < rows; ++i) {
      r.put(t, i);
      r.next();
    }
  }
  fs::path folder_, file_;
};

TEST_F(RecordTest, RowsComeBackAsPut) {
  {
    Record r = Record::create(file_, {{"case", "text"}});
    const auto t = r.add("time_s", "s", "-");
    const auto f = r.add("bodies/dipper/force", "N", "W", 3);
    for (int i = 0; i < 10000; ++i) {
      const double force[3] = {1.0 * i, 2.0 * i, 3.0 * i};
      r.put(t, 0.002 * i);
      r.put(f, force);
      r.next();
      if (i % 777 == 0) r.flush();
    }
    EXPECT_EQ(r.rows(), 10000u);
  }
  const auto time = read_channel(file_, "time_s");
  const auto fz = read_channel(file_, "bodies/dipper/force", 2);
  ASSERT_EQ(time.size(), 10000u);
  EXPECT_EQ(time[9999], 0.002 * 9999);
  EXPECT_EQ(fz[5000], 15000);
}

TEST_F(RecordTest, AKilledRunsRecordOpensUpToItsLastFlush) {
  const pid_t child = fork();
  if (child == 0) {
    Record r = Record::create(file_, {});
    const auto t = r.add("time_s", "s", "-");
    for (int i = 0; i < 5000; ++i) {
      r.put(t, i);
      r.next();
      if (i == 4321) r.flush();
    }
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto t = read_channel(file_, "time_s");
  ASSERT_EQ(t.size(), 4322u);
  EXPECT_EQ(t.back(), 4321);
}

TEST_F(RecordTest, AContinuedRecordIsCutBackToTheCheckpoint) {
  write_rows(100);
  {
    Record r = Record::resume(file_, 60);
    const auto t = r.add("time_s", "s", "-");
    r.put(t, -1);
    r.next();
  }
  const auto t = read_channel(file_, "time_s");
  ASSERT_EQ(t.size(), 61u);
  EXPECT_EQ(t[59], 59);
  EXPECT_EQ(t[60], -1);
}

TEST_F(RecordTest, ARecordThatLacksRowsOfTheCheckpointIsNotFilledUp) {
  write_rows(50);
  Record r = Record::resume(file_, 60);
  EXPECT_THAT([&] { r.add("time_s", "s", "-"); },
              testing::ThrowsMessage<InputError>(testing::AllOf(
                  testing::HasSubstr("time_s"), testing::HasSubstr("50 rows, the checkpoint 60"))));
}

TEST_F(RecordTest, AFullDiskIsAnErrorThatNamesTheFile) {
  // /dev/full refuses every write.
  try {
    Record r = Record::create("/dev/full", {});
    const auto t = r.add("time_s", "s", "-");
    r.put(t, 1);
    r.next();
    r.flush();
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("/dev/full"));
  }
}

TEST_F(RecordTest, AnAttributeOrDatasetThatCannotBeCreatedIsAnError) {
  const std::string too_long(70'000, 'x');  // HDF5 takes 64 KiB
  try {
    Record r = Record::create(file_, {{"case", too_long}});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("attribute 'case'"));
    EXPECT_THAT(e.what(), HasSubstr(file_.string()));
  }
  const fs::path other = folder_ / "other.h5", third = folder_ / "third.h5";
  {
    Record r = Record::create(other, {});
    EXPECT_THROW(r.add("time_s", too_long, "-"), std::runtime_error);
  }
  Record r = Record::create(third, {});
  r.add("time_s", "s", "-");
  EXPECT_THROW(r.add("time_s", "s", "-"), std::runtime_error);
}

TEST_F(RecordTest, AnAttributeIsReadBack) {
  { Record r = Record::create(file_, {{"case", "a = 1\n"}, {"note", ""}}); }
  EXPECT_EQ(read_attribute(file_, "case"), "a = 1\n");
  EXPECT_EQ(read_attribute(file_, "note"), "");
  EXPECT_EQ(read_attribute(file_, "none"), "");
}

TEST_F(RecordTest, AColumnThatIsNotThereIsAnError) {
  {
    Record r = Record::create(file_, {});
    r.add("force", "N", "W", 3);
    r.next();
  }
  EXPECT_EQ(read_channel(file_, "force", 2).size(), 1u);
  EXPECT_THAT([&] { read_channel(file_, "force", 3); },
              ThrowsMessage<InputError>(HasSubstr("force: has no column 3, only 3")));
}

TEST_F(RecordTest, MissingFileAndDatasetAreNamed) {
  const auto missing = ThrowsMessage<InputError>(HasSubstr(file_.string() + ": is missing"));
  EXPECT_THAT([&] { read_channel(file_, "time_s"); }, missing);
  EXPECT_THAT([&] { read_attribute(file_, "version"); }, missing);
  std::ofstream(file_) << "no record";
  EXPECT_THAT([&] { read_channel(file_, "time_s"); },
              ThrowsMessage<InputError>(HasSubstr("cannot be read as a run's record")));
  { Record r = Record::create(file_, {}); }
  EXPECT_THAT([&] { read_channel(file_, "no/such"); },
              ThrowsMessage<InputError>(HasSubstr(file_.string() + ": no/such: no such dataset")));
}

}  // namespace
}  // namespace dipper::record
