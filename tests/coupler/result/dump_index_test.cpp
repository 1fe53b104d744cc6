#include "coupler/result/dump_index.hpp"

#include <gtest/gtest.h>

#include "tests/analysis/dump_files.hpp"

namespace dipper::result {
namespace {

TEST(DumpIndex, FramesAfterACheckpointGo) {
  const analysis::Scratch s;
  const auto there = [&](const char* name) { return std::filesystem::exists(s.folder() / name); };
  for (const char* name : {"rocks_0.dump.gz", "rocks_90.dump.gz", "rocks_100.dump.gz",
                           "rocks_110.dump.gz", "rocks_110.dump", "rocks_90.dump.part12.gz",
                           "dipper_110.vtk", "truck_0.vtk", "dipper.vtk.series", "notes_2b.txt"})
    s.write(name, "");
  drop_frames_after(s.folder(), 100);
  for (const char* gone :
       {"rocks_110.dump.gz", "rocks_110.dump", "rocks_90.dump.part12.gz", "dipper_110.vtk"})
    EXPECT_FALSE(there(gone)) << gone;
  for (const char* kept : {"rocks_0.dump.gz", "rocks_90.dump.gz", "rocks_100.dump.gz",
                           "truck_0.vtk", "dipper.vtk.series", "notes_2b.txt"})
    EXPECT_TRUE(there(kept)) << kept;
}

}  // namespace
}  // namespace dipper::result
