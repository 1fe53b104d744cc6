// A copy of the narrow case as cases/quick, its machine and its meshes in a temporary folder, to be
// broken.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "tests/places.hpp"

namespace dipper::test {

namespace fs = std::filesystem;

inline std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class Checkout {
 public:
  /// With the first 12 rows of the motion, a few seconds, when the rest does not matter: a check
  /// takes as long as the motion.
  explicit Checkout(bool whole_motion = false) {
    std::string name = (fs::temp_directory_path() / "dipper-case-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root = name;
    const fs::path source = test::source();
    fs::create_directories(root / "cases");
    fs::create_directories(root / "mbs");
    fs::copy(source / "tests/coupler/case/narrow", folder(), fs::copy_options::recursive);
    std::string text = read_text(file());
    for (std::size_t at; (at = text.find("../../../../")) != std::string::npos;)
      text.replace(at, 12, "../../");
    write_text(file(), text);
    fs::copy(source / "meshes", root / "meshes", fs::copy_options::recursive);
    fs::copy(source / "mbs/bucyrus495.yaml", root / "mbs/bucyrus495.yaml");
    if (whole_motion) return;
    const std::string motion = read_text(folder() / "motion.csv");
    std::size_t end = motion.find("time_s");
    for (int row = 0; row <= 12; ++row) end = motion.find('\n', end) + 1;
    write_text(folder() / "motion.csv", motion.substr(0, end));
  }
  ~Checkout() { fs::remove_all(root); }
  Checkout(const Checkout&) = delete;
  Checkout& operator=(const Checkout&) = delete;

  fs::path folder() const { return root / "cases/quick"; }
  fs::path file() const { return folder() / "case.yaml"; }

  /// The line (1-based) of case.yaml that begins with `start`, blanks aside; 0 when none does.
  int line(const std::string& start) const {
    std::istringstream in(read_text(file()));
    int number = 1;
    for (std::string text; std::getline(in, text); ++number) {
      const auto first = text.find_first_not_of(" -{");
      if (first != std::string::npos && text.compare(first, start.size(), start) == 0) {
        return number;
      }
    }
    return 0;
  }

  /// Puts `text` (indented like what it replaces; may hold several lines or none) in the place of
  /// the line that begins with `start`. Returns the number of that line.
  int replace(const std::string& start, const std::string& text) {
    const int at = line(start);
    EXPECT_GT(at, 0) << "no line begins with " << start;
    std::istringstream in(read_text(file()));
    std::string out;
    int number = 1;
    for (std::string old; std::getline(in, old); ++number) {
      if (number != at) {
        out += old + "\n";
        continue;
      }
      const std::string indent = old.substr(0, old.find_first_not_of(' '));
      std::istringstream lines(text);
      for (std::string next; std::getline(lines, next);) out += indent + next + "\n";
    }
    write_text(file(), out);
    return at;
  }

  fs::path root;
};

/// One finding that a test expects. `message` is a part of the whole.
struct Expected {
  fs::path file;
  int line;
  std::string key;
  std::string message;
};

inline void expect_findings(const std::vector<Finding>& found,
                            const std::vector<Expected>& expected) {
  std::string all;
  for (const Finding& f : found) all += to_string(f) + "\n";
  EXPECT_EQ(found.size(), expected.size()) << all;
  for (const Expected& e : expected) {
    bool seen = false;
    for (const Finding& f : found) {
      seen = seen || (f.file == e.file && f.line == e.line && f.key == e.key &&
                      f.message.find(e.message) != std::string::npos);
    }
    EXPECT_TRUE(seen) << e.file << ":" << e.line << ": " << e.key << ": ..." << e.message
                      << "...\nis not in\n"
                      << all;
  }
}

}  // namespace dipper::test
