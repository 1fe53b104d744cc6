// Runs LIGGGHTS for a test.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/places.hpp"

namespace dipper::deck {

/// A fresh, empty folder under the test's temporary one.
inline std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("dipper_deck_" + name + "_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// DIPPER_LIGGGHTS of the environment, or the plain binary.
inline std::string liggghts_program() {
  const char* own = std::getenv("DIPPER_LIGGGHTS");
  return own != nullptr ? own : test::liggghts().string();
}

/// Starts LIGGGHTS in the repository with the arguments, on `ranks` ranks. The screen goes to
/// out/screen.txt, never to none: a mesh prints to it. Returns the exit status.
inline int run_liggghts(const std::string& deck, const std::string& arguments, int ranks,
                        const std::filesystem::path& out) {
  const std::string mpi =
      ranks == 1 ? "" : "mpirun --allow-run-as-root --oversubscribe -np " + std::to_string(ranks);
  const std::string command = "cd '" + test::source().string() + "' && " + mpi + " '" +
                              liggghts_program() + "' -in " + deck + " -var bench_cut '" +
                              test::bench_cut().string() + "' -var out '" + out.string() +
                              "' -log '" + (out / "log.txt").string() + "' " + arguments + " > '" +
                              (out / "screen.txt").string() + "' 2>&1";
  return std::system(command.c_str());
}

}  // namespace dipper::deck
