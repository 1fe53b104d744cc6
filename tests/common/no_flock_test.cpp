// A lock where the file system has none: this program's own flock refuses, as that one's does.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "common/file_lock.hpp"
#include "common/host_identity.hpp"
#include "common/temporary_folder.hpp"

namespace {
int refusal = ENOLCK;
}

extern "C" int flock(int /*fd*/, int /*operation*/) {
  errno = refusal;
  return -1;
}

namespace dipper {
namespace {

class NoFlock : public testing::TestWithParam<int> {
 protected:
  void SetUp() override { refusal = GetParam(); }
  TemporaryFolder temporary_{"no-flock"};
  std::filesystem::path file_ = temporary_.path() / "a.lock";
  std::filesystem::path held_ = temporary_.path() / "a.lock.held";
};

TEST_P(NoFlock, OneAtATime) {
  {
    FileLock first(file_), second(file_);
    EXPECT_TRUE(first.try_lock());
    EXPECT_FALSE(second.try_lock());
    EXPECT_EQ(second.owner(), getpid());
  }
  EXPECT_FALSE(std::filesystem::exists(held_));
  FileLock third(file_);
  EXPECT_TRUE(third.try_lock());
}

TEST_P(NoFlock, WhatAKilledProcessLeavesKeepsNobodyOut) {
  const pid_t child = fork();
  if (child == 0) {
    FileLock lock(file_);
    _exit(lock.try_lock() ? 0 : 1);  // without its destructor
  }
  int status = 1;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  ASSERT_TRUE(std::filesystem::exists(held_));
  FileLock lock(file_);
  EXPECT_TRUE(lock.try_lock());
}

TEST_P(NoFlock, AnotherHostsIsNotTouched) {
  std::ofstream(held_) << "another-" << host_name() << " 1\n";
  FileLock lock(file_);
  EXPECT_FALSE(lock.try_lock());
  EXPECT_TRUE(std::filesystem::exists(held_));
}

INSTANTIATE_TEST_SUITE_P(FileSystems, NoFlock, testing::Values(ENOSYS, ENOLCK, EOPNOTSUPP, EINVAL));

}  // namespace
}  // namespace dipper
