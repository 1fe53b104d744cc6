#include "coupler/launch/mpirun.hpp"

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>

namespace dipper::launch {
namespace {

bool copies_through_shared_memory() {
  const auto words = mpirun(2, {"program"}, {});
  const auto at = std::find(words.begin(), words.end(), "btl_vader_single_copy_mechanism");
  return at != words.end() && *(at + 1) == "none";
}

/// From here on the kernel refuses this process the memory of others, as containers have it.
bool refuse_memory_of_others() {
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_process_vm_readv, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog program{sizeof filter / sizeof *filter, filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

TEST(Mpirun, PassesMessagesThroughSharedMemoryWhereTheMemoryOfOthersIsRefused) {
  const bool before =
      copies_through_shared_memory();  // makes the folder, which this process removes
  const pid_t child = fork();
  if (child == 0) _exit(!refuse_memory_of_others() ? 2 : copies_through_shared_memory() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "2: the kernel knows no seccomp";
  EXPECT_EQ(copies_through_shared_memory(), before) << "the child's filter is its own";
}

TEST(Mpirun, AUsersOwnWordStands) {
  MpiPlaces places;
  places.options = {"--mca", "btl_vader_single_copy_mechanism", "cma"};
  const auto words = mpirun(2, {"program"}, places);
  EXPECT_EQ(std::count(words.begin(), words.end(), "btl_vader_single_copy_mechanism"), 1);
}

}  // namespace
}  // namespace dipper::launch
