#include "common/manifest.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>

namespace dipper {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class Manifest : public testing::Test {
 protected:
  Manifest() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "below");
    write(folder_ / "a.bin", std::string("\0\n\xff", 3) + std::string(100'000, 'x'));
    write(folder_ / "below" / "b c.txt", "text");
    write(folder_ / "empty", "");
    seal(folder_);
  }
  ~Manifest() override { fs::remove_all(folder_); }

  const fs::path folder_ = fs::path(testing::TempDir()) / ("manifest" + std::to_string(getpid()));
};

TEST_F(Manifest, AnUntouchedFolderIsSound) {
  EXPECT_EQ(damage_of(folder_), "");
  const std::string check = "cd '" + folder_.string() + "' && sha256sum --quiet -c " + kManifest;
  EXPECT_EQ(std::system(check.c_str()), 0);
}

TEST_F(Manifest, AnyFlippedBitIsFound) {
  for (const fs::path& file : {folder_ / "a.bin", folder_ / "below" / "b c.txt"}) {
    const std::string whole = read(file);
    for (const std::size_t at : {std::size_t{0}, whole.size() / 2, whole.size() - 1}) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ 4);
      write(file, flipped);
      EXPECT_THAT(damage_of(folder_),
                  HasSubstr(file.string() + " has changed since it was written"));
    }
    write(file, whole);
  }
  EXPECT_EQ(damage_of(folder_), "");
}

TEST_F(Manifest, AFileCutShortOrGoneIsFound) {
  const fs::path file = folder_ / "a.bin";
  const std::string whole = read(file);
  write(file, whole.substr(0, whole.size() - 1));
  EXPECT_THAT(damage_of(folder_), HasSubstr("a.bin has changed since it was written"));
  write(file, whole + "x");
  EXPECT_THAT(damage_of(folder_), HasSubstr("a.bin has changed since it was written"));
  fs::remove(file);
  EXPECT_THAT(damage_of(folder_), HasSubstr("a.bin is missing"));
}

TEST_F(Manifest, EveryFlippedBitAndEveryCutOfTheManifestIsFound) {
  const fs::path file = folder_ / kManifest;
  const std::string whole = read(file);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    write(file, changed);
    EXPECT_NE(damage_of(folder_), "") << at;
    write(file, whole.substr(0, at));
    EXPECT_NE(damage_of(folder_), "") << at;
  }
  fs::remove(file);
  EXPECT_THAT(damage_of(folder_), HasSubstr("manifest.sha256 is missing"));
}

TEST_F(Manifest, AProcessKilledWhileItSealsLeavesNoHalfOfOne) {
  fs::remove(folder_ / kManifest);
  const auto sealing_killed = [&] {
    const rlimit bytes{100, 100};  // beyond which a write kills the process; a manifest has more
    setrlimit(RLIMIT_FSIZE, &bytes);
    seal(folder_);
  };
  EXPECT_EXIT(sealing_killed(), testing::KilledBySignal(SIGXFSZ), "");
  EXPECT_NO_THROW(require_undamaged(folder_));
}

TEST_F(Manifest, WhatIsDamagedIsMovedOutOfTheWay) {
  const fs::path aside = set_aside(folder_);
  EXPECT_EQ(aside, folder_.string() + ".damaged");
  EXPECT_FALSE(fs::exists(folder_));
  fs::create_directories(folder_);
  write(folder_ / "second", "");
  set_aside(folder_);
  EXPECT_TRUE(fs::exists(aside / "second"));
  EXPECT_FALSE(fs::exists(aside / "a.bin"));
  fs::remove_all(aside);
}

}  // namespace
}  // namespace dipper
