#include "coupler/launch/failure_message.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace dipper::launch {
namespace {

namespace fs = std::filesystem;

class FailureMessage : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    const fs::path file = fs::temp_directory_path() / (name + std::to_string(getpid()));
    std::ofstream(file) << text;
    files_.push_back(file);
    return file;
  }
  ~FailureMessage() override {
    for (const auto& f : files_) fs::remove(f);
  }
  std::vector<fs::path> files_;
};

TEST_F(FailureMessage, LiggghtsErrorComesFirst) {
  const auto log = write("log", "mpirun noticed that process rank 0 exited on signal 6\n");
  const auto screen = write("screen", "Step Atoms\n0 10\nERROR: Mesh left the box (mesh.cpp:1)\n");
  EXPECT_EQ(error_line(log, screen), "ERROR: Mesh left the box (mesh.cpp:1)");
}

TEST_F(FailureMessage, ASidesOwnLineBeatsMpirun) {
  const auto log = write("log",
                         "dipper-dem: the deck has no fix for body 'door'\n"
                         "-----\nmpirun has exited due to process rank 0\n-----\n");
  EXPECT_EQ(error_line(log), "dipper-dem: the deck has no fix for body 'door'");
}

TEST_F(FailureMessage, ASignalIsReportedAsMpirunSawIt) {
  const auto log =
      write("log", "---\nmpirun noticed that process rank 1 exited on signal 9\n---\n");
  EXPECT_EQ(error_line(log), "mpirun noticed that process rank 1 exited on signal 9");
}

TEST_F(FailureMessage, WhatAProgramSaidBeatsWhatMpirunSaysOfAnAbort) {
  const auto log = write("log",
                         "sh: 1: ./bench-cut: not found\n-----\nMPI_ABORT was invoked on rank 0\n"
                         "exactly when Open MPI kills them.\n-----\n");
  EXPECT_EQ(error_line(log), "sh: 1: ./bench-cut: not found");
}

TEST_F(FailureMessage, OpenMpisTroubleWithAMessageIsNotTheCause) {
  const auto log = write("log",
                         "dipper-liggghts: 1 rank came up where 2 belong\n"
                         "[h1:1] [[2,0],0] ORTE_ERROR_LOG: Data unpack would read past end\n");
  EXPECT_EQ(error_line(log), "dipper-liggghts: 1 rank came up where 2 belong");
}

TEST_F(FailureMessage, LiggghtsLineIsFoundAmongWhatMpiSaysAfterIt) {
  const std::string box =
      "--------------------------------------------------------------------------\n"
      "MPI_ABORT was invoked on rank 1 in communicator MPI_COMM_WORLD\nwith errorcode 1.\n"
      "--------------------------------------------------------------------------\n"
      "[h1:77] PMIX ERROR: UNREACHABLE in file server/pmix_server.c at line 2198\n"
      "[h1:77] 1 more process has sent help message help-mpi-api.txt / mpi-abort\n"
      "mpirun has exited due to process rank 1\n";
  const char* own[] = {
      "ERROR on proc 1: Out of range atoms - cannot compute (pppm.cpp:1945)",
      "ERROR: Fix mesh/surface/stress (id dipper): mesh has 2 faces with an angle of 0.03 "
      "degree (surface_mesh_I.h:503)",
      "ERROR: Unknown command: paire_style gran (../input.cpp:275)",
      "ERROR: Lost atoms: original 120 current 119 (thermo.cpp:437)",
  };
  for (const std::string line : own) {
    EXPECT_EQ(error_line(write("log", line + "\n" + box)), line);
    EXPECT_EQ(error_line(write("log", box), write("screen", "Setting up run\n" + line + "\n")),
              line);
  }
}

TEST_F(FailureMessage, AHostThatIsGoneIsNamed) {
  const auto log = write("log",
                         "Please note that this is a mesh\n-----\n"
                         "ORTE has lost communication with a remote daemon.\n\n"
                         "  HNP daemon   : [[5,0],0] on node h1\n"
                         "  Remote daemon: [[5,0],1] on node h2\n-----\n");
  EXPECT_EQ(error_line(log), "mpirun has lost the host h2");
}

TEST_F(FailureMessage, NothingSaidIsEmpty) {
  EXPECT_EQ(error_line(write("log", "")), "");
  EXPECT_EQ(error_line("/no/such/file"), "");
}

TEST_F(FailureMessage, AKillIsNamedAndNotWhatWasSaidBeforeIt) {
  const auto log = write("log", "WARNING: Dangerous settings (neighbor.cpp:7)\n");
  Process killed({"sh", "-c", "kill -KILL $$"}, log);
  ASSERT_TRUE(killed.wait(std::chrono::seconds(10)));
  EXPECT_TRUE(killed.was_killed());
  EXPECT_EQ(failure_message(killed, log), "sh was killed by signal 9 (Killed)");

  Process failed({"sh", "-c", "exit 3"}, log);
  ASSERT_TRUE(failed.wait(std::chrono::seconds(10)));
  EXPECT_FALSE(failed.was_killed());
  EXPECT_EQ(failure_message(failed, log),
            "WARNING: Dangerous settings (neighbor.cpp:7) (exit status 3)");
}

TEST_F(FailureMessage, AKilledRankBeatsWhatItSaidBefore) {
  const auto log = write("log",
                         "dipper-dem: 3 rocks removed\n"
                         "mpirun noticed that process rank 1 exited on signal 9\n");
  EXPECT_EQ(error_line(log), "mpirun noticed that process rank 1 exited on signal 9");
}

/// A folder with an mpirun of its own, first on PATH.
class OtherMpirun {
 public:
  explicit OtherMpirun(const std::string& script) {
    fs::create_directory(folder_);
    std::ofstream(folder_ / "mpirun") << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / "mpirun", fs::perms::owner_all);
    setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }
  ~OtherMpirun() {
    setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }
  std::string file() const { return folder_ / "mpirun"; }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("other_mpirun" + std::to_string(getpid()));
  std::string path_ = std::getenv("PATH");
};

TEST_F(FailureMessage, AnMpirunThatIsNotOpenMpisIsNamed) {
  const OtherMpirun other(
      "echo '[mpiexec@h1] match_arg: unrecognized argument oversubscribe' >&2\n"
      "echo 'Usage: ./mpiexec [global opts]' >&2\nexit 255\n");
  const auto log = write("log", "");
  Process failed({"mpirun", "-np", "2", "true"}, log);
  ASSERT_TRUE(failed.wait(std::chrono::seconds(10)));
  EXPECT_EQ(failure_message(failed, log),
            other.file() +
                " is not Open MPI's, which this program takes; put that one's folder first in PATH;"
                " it says '[mpiexec@h1] match_arg: unrecognized argument oversubscribe' "
                "(exit status 255)");
}

TEST_F(FailureMessage, AnMpirunThatStartsNothingAndIsContentIsNamed) {
  const OtherMpirun other("exit 0\n");
  const auto log = write("log", "");
  Process failed({"mpirun", "-np", "2", "true"}, log);
  ASSERT_TRUE(failed.wait(std::chrono::seconds(10)));
  EXPECT_EQ(failure_message(failed, log).rfind(other.file() + " is not Open MPI's", 0), 0U);
}

TEST_F(FailureMessage, NoMpirunIsReportedWithWhatToInstall) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/none", 1);
  const auto log = write("log", "");
  Process failed({"mpirun", "-np", "2", "true"}, log);
  ASSERT_TRUE(failed.wait(std::chrono::seconds(10)));
  EXPECT_EQ(failure_message(failed, log),
            "no mpirun on PATH; install Open MPI (openmpi-bin), or put its folder into PATH "
            "(exit status 127)");
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace dipper::launch
