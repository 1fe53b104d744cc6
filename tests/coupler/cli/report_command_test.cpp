// `dipper report` on dumps that are no run's: what it computes, and what it refuses.
#include "coupler/cli/report_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/file_lock.hpp"
#include "common/mesh/stl.hpp"
#include "tests/analysis/dump_files.hpp"
#include "tests/analysis/tray.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// A layer of spheres on the ground, 0.2 m apart, and ten in the tray's cavity that rests at
/// (0, 0, 5).
void write_dumps(const analysis::Scratch& s) {
  for (const long step : {0, 100}) {
    std::string rows;
    int id = 0;
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j < 10; ++j)
        rows += std::to_string(++id) + " " + std::to_string(5 + 0.2 * i) + " " +
                std::to_string(0.2 * j) + " 0.1 0.1 2500\n";
    for (int i = 0; i < 10; ++i)
      rows += std::to_string(++id) + " " + std::to_string(0.15 + 0.15 * i) + " 0 5 0.1 2500\n";
    s.write("post/dump" + std::to_string(step) + ".liggghts",
            analysis::text_frame(step, 310, "id x y z radius density", rows));
  }
  s.write("tray.stl", mesh::to_stl("tray", analysis::tray()));
  s.write("tray.csv", "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,5,1,0,0,0\n1,0,0,5,1,0,0,0\n");
}

ReportOptions options(const analysis::Scratch& s) {
  ReportOptions w;
  w.folder = (s.folder() / "post").string();
  w.timestep_s = 1e-3;
  return w;
}

nlohmann::json metrics_of(const analysis::Scratch& s) {
  std::ifstream in(s.folder() / "post/report/metrics.json");
  return nlohmann::json::parse(in);
}

constexpr double kBall_kg = 2500 * 4.0 / 3.0 * M_PI * 1e-3;

TEST(ReportCommand, WorksOnDumpsAlone) {
  const analysis::Scratch s;
  write_dumps(s);
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(options(s), reporter), 0);
  const auto m = metrics_of(s);
  EXPECT_EQ(m["source"]["kind"], "dumps");
  EXPECT_EQ(m["source"]["mass_from"], "spheres");
  EXPECT_NEAR(m["frames"]["rock_kg"][1], 310 * kBall_kg, 1e-6);
  EXPECT_NEAR(m["frames"]["time_s"][1], 0.1, 1e-12);
  EXPECT_FALSE(m.contains("passes"));
  EXPECT_FALSE(m.contains("dipper"));
  EXPECT_FALSE(m["frames"].contains("in_dipper_kg"));
  EXPECT_NEAR(m["sizes"][0]["size_m"], 0.2, 1e-9);
  EXPECT_TRUE(fs::exists(s.folder() / "post/report/frames.csv"));
}

TEST(ReportCommand, TakesThePlaceOfAnEarlierReportAndOfNothingElse) {
  const analysis::Scratch s;
  write_dumps(s);
  s.write("precious/notes.txt", "mine");
  ReportOptions w = options(s);
  for (const char* place : {"precious", "post", "."}) {
    w.out = (s.folder() / place).string();
    test::MemoryReporter reporter;
    EXPECT_EQ(report_command(w, reporter), 2);
    EXPECT_THAT(reporter.errors, HasSubstr("is not a report, and a report would replace it"));
  }
  EXPECT_TRUE(fs::exists(s.folder() / "precious/notes.txt"));
  EXPECT_TRUE(fs::exists(s.folder() / "post/dump0.liggghts"));
  w.out = (s.folder() / "again").string();
  for (int k = 0; k < 2; ++k) {
    test::MemoryReporter reporter;
    EXPECT_EQ(report_command(w, reporter), 0);
  }
}

TEST(ReportCommand, WithAMeshAndPosesItKnowsTheDippersLoad) {
  const analysis::Scratch s;
  write_dumps(s);
  ReportOptions w = options(s);
  w.mesh = (s.folder() / "tray.stl").string();
  w.poses = (s.folder() / "tray.csv").string();
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(w, reporter), 0);
  const auto m = metrics_of(s);
  EXPECT_NEAR(m["dipper"]["struck_volume_m3"], 3.0, 0.03);
  EXPECT_NEAR(m["frames"]["in_dipper_kg"][0], 10 * kBall_kg, 1e-6);
  EXPECT_FALSE(m["frames"].contains("bulk_kg")) << "without velocities nothing flows or rests";
}

/// Exit status 2, the message as an error, and no report nor half of one.
std::string refused(const analysis::Scratch& s, const ReportOptions& w) {
  test::MemoryReporter reporter;
  const int status = report_command(w, reporter);
  const std::string& message = reporter.errors;
  EXPECT_EQ(status, 2) << message;
  for (const auto& entry : fs::directory_iterator(s.folder() / "post"))
    EXPECT_TRUE(entry.is_regular_file()) << entry.path();
  return message;
}

TEST(ReportCommand, RefusesWhatIsWrongBeforeItWrites) {
  const analysis::Scratch s;
  write_dumps(s);
  ReportOptions w = options(s);
  w.mesh = (s.folder() / "tray.stl").string();
  EXPECT_THAT(refused(s, w), HasSubstr("--mesh and --poses"));
  w.poses = s.write("bad.csv", "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,0,5,2,0,0,0\n").string();
  EXPECT_THAT(refused(s, w), HasSubstr("bad.csv:2: qw ... qz is not a rotation"));
  s.write("bad.csv", "time_s,x_m\n");
  EXPECT_THAT(refused(s, w), HasSubstr("bad.csv:1:1: header is"));

  mesh::TriangleMesh open = analysis::tray();
  open.triangles.erase(open.triangles.begin() + 4);
  w.mesh = s.write("open.stl", mesh::to_stl("open", open)).string();
  w.poses = (s.folder() / "tray.csv").string();
  EXPECT_THAT(refused(s, w), HasSubstr("open.stl: does not enclose a volume: facet"));
  w.mesh = s.write("not.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n").string();
  EXPECT_THAT(refused(s, w), HasSubstr("not.stl:5: "));

  ReportOptions plain = options(s);
  s.write("post/dump100.liggghts",
          analysis::text_frame(100, 310, "id x y z radius density", "1 0 0 0 1 1\n"));
  EXPECT_THAT(refused(s, plain),
              HasSubstr("dump100.liggghts:11: the frame of step 100 ends after 1"));
  s.write("post/dump100.liggghts", analysis::text_frame(100, 1, "id x y z density", "1 0 0 0 1\n"));
  EXPECT_THAT(refused(s, plain), HasSubstr("dump100.liggghts:9: particles without radius"));
  s.write("post/dump100.liggghts",
          analysis::text_frame(100, 1, "id x y z radius mass", "1 0 0 0 0.1 1\n"));
  plain.timestep_s.reset();
  EXPECT_THAT(refused(s, plain), HasSubstr("the time step is not known"));
}

/// The tray, `scale` times as large, with these poses.
ReportOptions with_tray(const analysis::Scratch& s, double scale, const std::string& poses) {
  mesh::TriangleMesh tray = analysis::tray();
  for (auto& v : tray.vertices) v *= scale;
  ReportOptions w = options(s);
  w.mesh = s.write("scaled.stl", mesh::to_stl("tray", tray)).string();
  w.poses = s.write("poses.csv", "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + poses).string();
  return w;
}

TEST(ReportCommand, RefusesADipperInAnotherUnit) {
  const analysis::Scratch s;
  write_dumps(s);
  const std::string there = "0,0,0,5,1,0,0,0\n1,0,0,5,1,0,0,0\n";
  for (const double scale : {1000.0, 100.0})
    EXPECT_THAT(refused(s, with_tray(s, scale, there)),
                HasSubstr("and the box of the dumps 20 m: in mm or cm, perhaps?"));
  for (const std::string far : {"0,0,0,5000,1,0,0,0\n1,0,0,5000,1,0,0,0\n",  // in mm
                                "0,40,0,5,1,0,0,0\n1,40,0,5,1,0,0,0\n",      // never near
                                "0,0,0,5,1,0,0,0\n0.1,5000,0,5,1,0,0,0\n"})  // in mm, from 0
    EXPECT_THAT(refused(s, with_tray(s, 1, far)), HasSubstr("poses.csv: x_m,y_m,z_m: they put"));
}

TEST(ReportCommand, WarnsOfADipperLongerThanAllTheRock) {
  const analysis::Scratch s;
  write_dumps(s);
  for (const double scale : {1.0, 6.0}) {
    test::MemoryReporter reporter;
    EXPECT_EQ(report_command(with_tray(s, scale, "0,0,0,5,1,0,0,0\n"), reporter), 0)
        << reporter.errors;
    EXPECT_EQ(reporter.lines.find("the rock") != std::string::npos, scale > 1) << reporter.lines;
  }
}

TEST(ReportCommand, RefusesPosesOfAnotherTime) {
  const analysis::Scratch s;
  write_dumps(s);  // 0 to 0.1 s
  const std::string at = ",0,0,5,1,0,0,0\n";
  EXPECT_THAT(refused(s, with_tray(s, 1, "0" + at + "0.05" + at)),
              HasSubstr("the poses cover 0 to 0.05 s, the frames 0 to 0.1 s; write poses from"));
  EXPECT_THAT(refused(s, with_tray(s, 1, "100" + at + "101" + at)), HasSubstr("cover 100 to 101"));
  EXPECT_THAT(refused(s, with_tray(s, 1, "0" + at + "50" + at + "100" + at)), HasSubstr("in ms,"));
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(with_tray(s, 1, "0" + at + "0.0999" + at), reporter), 0);
}

TEST(ReportCommand, OfARunInProgressWithoutDumpsSaysSo) {
  const analysis::Scratch s;
  s.write("post/record.h5", "rows");
  fs::create_directories(s.folder() / "post/dumps");
  ReportOptions w;
  w.folder = (s.folder() / "post").string();
  FileLock writer(s.folder() / "post/run.lock");
  ASSERT_TRUE(writer.try_lock());
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(w, reporter), 2);
  EXPECT_THAT(reporter.errors, HasSubstr("post: a run is writing it; wait for its end"));
}

TEST(ReportCommand, AFolderThatIsNotThereIsNamed) {
  const analysis::Scratch s;
  ReportOptions w;
  w.folder = (s.folder() / "not_there").string();
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(w, reporter), 2);
  EXPECT_THAT(reporter.errors, HasSubstr("not_there: no such folder"));
  EXPECT_FALSE(std::filesystem::exists(w.folder));
}

TEST(ReportCommand, WritesWhereAsked) {
  const analysis::Scratch s;
  write_dumps(s);
  ReportOptions w = options(s);
  test::MemoryReporter reporter;
  w.out = (s.folder() / "elsewhere").string();
  EXPECT_EQ(report_command(w, reporter), 0);
  EXPECT_TRUE(fs::exists(s.folder() / "elsewhere/metrics.json"));
  EXPECT_FALSE(fs::exists(s.folder() / "post/report"));
  w.out = (s.folder() / "no/such/report").string();
  EXPECT_EQ(report_command(w, reporter), 2);
  EXPECT_THAT(reporter.errors, HasSubstr("no/such: cannot be written into"));
}

TEST(ReportCommand, AFileBesideTheDumpsThatMayNotBeReadIsLeftAlone) {
  const analysis::Scratch s;
  write_dumps(s);
  fs::permissions(s.write("post/events", "secret"), fs::perms::none);
  s.write("post/README", "no extension either");
  test::MemoryReporter reporter;
  EXPECT_EQ(report_command(options(s), reporter), 0);
}

}  // namespace
}  // namespace dipper::cli
