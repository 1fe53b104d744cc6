#include "analysis/metrics/report_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/analysis/dump_files.hpp"

namespace dipper::analysis::metrics {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ToCsv, OfRowsHasEveryName) {
  const json rows = {{{"pass", 1}, {"mass_kg", 1.5}, {"shares", {10, 20}}, {"deep", {{"a", 1}}}},
                     {{"pass", 2}, {"name", "a \"b\", c"}}};
  EXPECT_EQ(to_csv(rows),
            "pass,mass_kg,shares_1,shares_2,name\n1,1.5,10,20,\n2,,,,\"a \"\"b\"\", c\"\n");
}

TEST(ToCsv, OfColumns) {
  EXPECT_EQ(to_csv({{"x_m", {1, 2}}, {"angle_deg", 34.5}, {"z_m", {3, 4}}}), "x_m,z_m\n1,3\n2,4\n");
}

Metrics metrics() {
  Metrics m;
  m.values = {{"format", 1}, {"passes", {{{"pass", 1}}}}};
  rock::WallField f;
  f.body = "dipper";
  f.field = "wear";
  f.middle_m = {{1, 2, 3}};
  f.area_m2 = {0.5};
  f.last = {7};
  f.mean = {4};
  f.max = {8};
  m.walls.push_back(f);
  return m;
}

TEST(WriteReport, HasMetricsAndTables) {
  const Scratch s;
  write_report(metrics(), s.folder() / "report");
  EXPECT_EQ(json::parse(bytes_of(s.folder() / "report/metrics.json")), metrics().values);
  EXPECT_EQ(bytes_of(s.folder() / "report/passes.csv"), "pass\n1\n");
  EXPECT_EQ(bytes_of(s.folder() / "report/wall_dipper_wear.csv"),
            "triangle,x_m,y_m,z_m,area_m2,last,mean,max\n0,1,2,3,0.5,7,4,8\n");
}

TEST(WriteReport, ThatFailsLeavesWhatWasThere) {
  const Scratch s;
  write_report(metrics(), s.folder() / "report");
  Metrics other = metrics();
  other.values["format"] = 2;
  const auto fail = [](const fs::path& made) {
    EXPECT_TRUE(fs::exists(made / "metrics.json"));
    throw std::runtime_error("no room");
  };
  EXPECT_THROW(write_report(other, s.folder() / "report", fail), std::runtime_error);
  EXPECT_THAT(bytes_of(s.folder() / "report/metrics.json"), HasSubstr("\"format\": 1"));
  std::size_t there = 0;
  for (const auto& entry : fs::directory_iterator(s.folder())) there += entry.exists() ? 1 : 0;
  EXPECT_EQ(there, 1u) << "the half-made folder is gone";
}

}  // namespace
}  // namespace dipper::analysis::metrics
