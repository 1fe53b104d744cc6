// No damage to a dump ends otherwise than read or refused, and none takes memory for what is not
// there.
#include <gtest/gtest.h>

#include "tests/analysis/io/damage.hpp"

namespace dipper::analysis::io {
namespace {

TEST(DamagedDumps, SamplesAreSound) {
  const Scratch s;
  for (const Sample& sample : samples(s.folder())) {
    s.write(sample.name, sample.bytes);
    if (sample.name == "rocks.vtp.series") {  // names a file: other readers' samples go first
      for (const auto& entry : std::filesystem::directory_iterator(s.folder()))
        if (entry.path().extension() == ".vtk" || entry.path().extension() == ".vtp")
          std::filesystem::remove(entry.path());
    }
    EXPECT_EQ(test::message_of([&] { read_all(s.folder() / sample.name); }), "") << sample.name;
  }
}

TEST(DamagedDumps, AreRefusedOrRead) {
  const long before = peak_kB();
  const Scratch s;
  for (const Sample& sample : samples(s.folder())) {
    const auto folder = s.folder() / ("of_" + sample.name);
    std::filesystem::create_directories(folder);
    s.write("of_" + sample.name + "/rocks_7.dump", samples(s.folder())[0].bytes);
    std::mt19937 random(16);
    for (int k = 0; k < 400; ++k) {
      const std::string wrong = try_damage(sample, folder, random);
      ASSERT_EQ(wrong, "") << sample.name << ", change " << k << ":\n"
                           << file_bytes(folder / sample.name);
    }
  }
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(peak_kB() - before, 60'000);
#endif
}

}  // namespace
}  // namespace dipper::analysis::io
