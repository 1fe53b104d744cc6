#include "coupler/result/dump_index.hpp"

#include <gtest/gtest.h>

#include "tests/analysis/dump_files.hpp"
#include "tests/coupler/case/checkout.hpp"

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

TEST(DumpIndex, HasASeriesForEachBodyWithFrames) {
  const analysis::Scratch s;
  for (const char* name : {"left_blade_0.vtk", "left_blade_100.vtk", "truck_0.vtk", "rocks_0.dump"})
    s.write(name, "");
  index_dumps(s.folder(), 0.1);
  EXPECT_NE(test::read_text(s.folder() / "left_blade.vtk.series").find("left_blade_100.vtk"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(s.folder() / "truck.vtk.series"));
  EXPECT_FALSE(std::filesystem::exists(s.folder() / "dipper.vtk.series"));
}

}  // namespace
}  // namespace dipper::result
