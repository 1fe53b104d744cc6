// Files for the tests of the dump readers, and the messages of what they throw.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/common/input_errors.hpp"

namespace dipper::analysis {

/// A folder of its own for the running test, empty; removed at its end.
class Scratch {
 public:
  Scratch()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("analysis_" + std::to_string(getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  const std::filesystem::path& folder() const { return folder_; }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = folder_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

 private:
  std::filesystem::path folder_;
};

/// As legacy VTK's binary files have them.
template <typename T>
std::string big_endian(std::initializer_list<T> values) {
  std::string out;
  for (T v : values) {
    char b[sizeof v];
    std::memcpy(b, &v, sizeof v);
    out.append(std::string(std::rbegin(b), std::rend(b)));
  }
  return out;
}

/// The most memory this process has had.
inline long peak_kB() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use.ru_maxrss;
}

/// One frame of a text dump with these column names and rows.
inline std::string text_frame(long step, int particles, const std::string& columns,
                              const std::string& rows) {
  return "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ATOMS\n" +
         std::to_string(particles) + "\nITEM: BOX BOUNDS ff ff ff\n0 10\n0 20\n-5 5\nITEM: ATOMS " +
         columns + " \n" + rows;
}

}  // namespace dipper::analysis
