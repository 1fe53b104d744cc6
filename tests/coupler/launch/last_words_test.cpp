#include "coupler/launch/last_words.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace dipper::launch {
namespace {

namespace fs = std::filesystem;

class LastWords : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) {
    const fs::path file = fs::temp_directory_path() / (name + std::to_string(getpid()));
    std::ofstream(file) << text;
    files_.push_back(file);
    return file;
  }
  ~LastWords() override {
    for (const auto& f : files_) fs::remove(f);
  }
  std::vector<fs::path> files_;
};

TEST_F(LastWords, LiggghtsErrorComesFirst) {
  const auto log = write("log", "mpirun noticed that process rank 0 exited on signal 6\n");
  const auto screen = write("screen", "Step Atoms\n0 10\nERROR: Mesh left the box (mesh.cpp:1)\n");
  EXPECT_EQ(last_words(log, screen), "ERROR: Mesh left the box (mesh.cpp:1)");
}

TEST_F(LastWords, ASidesOwnLineBeatsMpirun) {
  const auto log = write("log",
                         "dipper-dem: the deck has no fix for body 'door'\n"
                         "-----\nmpirun has exited due to process rank 0\n-----\n");
  EXPECT_EQ(last_words(log), "dipper-dem: the deck has no fix for body 'door'");
}

TEST_F(LastWords, ASignalIsReportedAsMpirunSawIt) {
  const auto log =
      write("log", "---\nmpirun noticed that process rank 1 exited on signal 9\n---\n");
  EXPECT_EQ(last_words(log), "mpirun noticed that process rank 1 exited on signal 9");
}

TEST_F(LastWords, NothingSaidIsEmpty) {
  EXPECT_EQ(last_words(write("log", "")), "");
  EXPECT_EQ(last_words("/no/such/file"), "");
}

}  // namespace
}  // namespace dipper::launch
