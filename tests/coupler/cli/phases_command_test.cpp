// `dipper phases`: the one definition of passes and phases, for who is not written in C++.
#include "coupler/cli/phases_command.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/signals/phases.hpp"
#include "common/record/record.hpp"
#include "tests/analysis/dump_files.hpp"
#include "tests/common/memory_reporter.hpp"

namespace dipper::cli {
namespace {

using nlohmann::json;

double ramp(double t, double t0, double t1) {
  return std::min(1.0, std::max(0.0, (t - t0) / (t1 - t0)));
}
double crowd(double t) { return -1 + 4 * ramp(t, 2, 12) - 4 * ramp(t, 20, 40); }
double swing(double t) { return 0.3 + ramp(t, 15, 25) - ramp(t, 35, 45); }

json readings() {
  json in = {{"passes", {{{"t_start_s", 0.0}, {"t_end_s", 50.0}}}}};
  for (int i = 0; i <= 150; ++i) {
    const double t = i / 3.0;
    in["time_s"].push_back(t);
    in["crowd_m"].push_back(crowd(t));
    in["swing_rad"].push_back(swing(t));
  }
  return in;
}

int ask(const std::string& folder, const std::string& text, json& answer) {
  std::istringstream in(text);
  test::MemoryReporter out;
  const int status = phases_command(folder, in, out);
  answer = out.lines.empty() ? json() : json::parse(out.lines);
  return status;
}

TEST(PhasesCommand, OfReadingsAreThoseOfTheLibraryToTheBit) {
  const json in = readings();
  json answer;
  ASSERT_EQ(ask("-", in.dump(), answer), 0);
  const auto wanted = analysis::signals::find_phases(
      {in["time_s"], {}, in["crowd_m"], in["swing_rad"], {}, {}}, 0, 50);
  ASSERT_EQ(answer["passes"].size(), 1U);
  const json& phases = answer["passes"][0]["phases"];
  ASSERT_EQ(phases.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    EXPECT_EQ(phases[k]["phase"], word(wanted[k].name));
    EXPECT_EQ(phases[k]["t_start_s"].get<double>(), wanted[k].t_start_s);
    EXPECT_EQ(phases[k]["t_end_s"].get<double>(), wanted[k].t_end_s);
  }
}

TEST(PhasesCommand, OfAMotionAreThePassesThatItsDoorEnds) {
  json answer;
  ASSERT_EQ(
      ask("-",
          R"({"time_s": [0, 1, 2, 3, 4, 5, 6, 7], "door_rad": [0, 1, 0.02, 0, 0, 0.03, 0, 0]})",
          answer),
      0);
  EXPECT_EQ(answer, json::parse(R"({"passes": [{"t_start_s": 0, "t_end_s": 2},
                                               {"t_start_s": 2, "t_end_s": 6}]})"));
  ASSERT_EQ(ask("-", R"({"time_s": [0, 1, 2], "door_rad": [0, 0, 1]})", answer), 0);
  EXPECT_EQ(answer["passes"][0]["t_end_s"], 2) << "the door is open at the end";
  ASSERT_EQ(ask("-", R"({"time_s": [0, 1], "door_rad": [0, 0]})", answer), 0);
  EXPECT_TRUE(answer["passes"].empty()) << "never opened";
  EXPECT_EQ(ask("-", R"({"time_s": [0, 1], "door_rad": [0]})", answer), 2);
}

TEST(PhasesCommand, RefusesWhatIsNoReadings) {
  json answer;
  json short_crowd = readings(), empty_pass = readings();
  short_crowd["crowd_m"].erase(0);
  empty_pass["passes"][0]["t_end_s"] = -1;
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string(R"({"time_s": "now"})"), short_crowd.dump(),
        empty_pass.dump()}) {
    EXPECT_EQ(ask("-", text, answer), 2) << text.substr(0, 40);
    EXPECT_TRUE(answer.is_null());
  }
}

/// A run that goes on for 2 s after the 50 s of its pass, or ends before.
void write_record(const std::filesystem::path& file, int rows = 521) {
  auto r = record::Record::create(file, {});
  const auto add = [&](const std::string& name, std::size_t columns = 1) {
    return r.add(name, "", "", columns);
  };
  const auto time = add("time_s"), door = add("machine/door"), out = add("machine/crowd"),
             turn = add("machine/swing"), inside = add("rock/mass_in_dipper"),
             truck = add("rock/mass_in_truck"), hoist_force = add("machine/hoist_force"),
             crowd_force = add("machine/crowd_force");
  for (const char* name : {"machine/rope_tension_left", "machine/rope_tension_right",
                           "machine/hoist_power", "machine/crowd_power", "machine/swing_power",
                           "machine/hoist", "rock/rock_mass", "coupling/rock_work"})
    add(name);
  std::size_t dipper_wrench = 0;
  for (const std::string body : {"dipper", "door"}) {
    const double standing[7] = {0, 0, 0, 1, 0, 0, 0};
    r.put(add("bodies/" + body + "/wall_pose", 7), standing);
    add("bodies/" + body + "/twist", 6);
    const auto wrench = add("bodies/" + body + "/wrench_mean", 6);
    if (body == "dipper") dipper_wrench = wrench;
  }
  for (int i = 0; i < rows; ++i) {
    const double t = 0.1 * i;
    const double wrench[6] = {0, 0, 0, t >= 3 && t < 15 ? 1e6 : 0, 0, 0};
    r.put(time, t);
    r.put(door, t >= 30 && t < 50 ? 1 : 0);
    r.put(out, crowd(t));
    r.put(turn, swing(t));
    r.put(inside, t > 12 && t < 32 ? 80e3 : 0);
    r.put(truck, t < 32 ? 0 : 80e3);
    r.put(hoist_force, 3e6);
    r.put(crowd_force, 4e6);
    r.put(dipper_wrench, wrench);
    r.next();
  }
  r.flush();
}

TEST(PhasesCommand, OfARunComeWithItsPasses) {
  const analysis::Scratch s;
  write_record(s.folder() / "record.h5");
  json answer;
  ASSERT_EQ(ask(s.folder().string(), "", answer), 0);
  ASSERT_EQ(answer["passes"].size(), 1U);
  const json& pass = answer["passes"][0];
  EXPECT_EQ(pass["pass"], 1);
  EXPECT_NEAR(pass["t_dig_s"], 3, 1e-9);
  EXPECT_NEAR(pass["t_dump_s"], 30, 1e-9);
  EXPECT_NEAR(pass["t_end_s"], 50, 1e-9);
  EXPECT_EQ(pass["dumped"], true);
  EXPECT_NEAR(pass["payload_kg"], 80e3, 1e-6);
  EXPECT_NEAR(pass["truck_kg"], 80e3, 1e-6);
  ASSERT_EQ(pass["phases"].size(), 7U);
  EXPECT_EQ(pass["phases"][4]["phase"], "swing");
  EXPECT_NEAR(pass["phases"][6]["t_end_s"], 52, 1e-9);  // the return belongs to the last pass
}

TEST(PhasesCommand, OfAnUnfinishedRunSayThatItHasNotDumped) {
  const analysis::Scratch s;
  write_record(s.folder() / "record.h5", 200);
  json answer;
  ASSERT_EQ(ask(s.folder().string(), "", answer), 0);
  ASSERT_EQ(answer["passes"].size(), 1U);
  EXPECT_EQ(answer["passes"][0]["dumped"], false);
}

TEST(PhasesCommand, RefusesAFolderThatIsNoRun) {
  const analysis::Scratch s;
  json answer;
  EXPECT_EQ(ask(s.folder().string(), "", answer), 2);
  s.write("record.h5", "not HDF5");
  EXPECT_EQ(ask(s.folder().string(), "", answer), 2);
}

}  // namespace
}  // namespace dipper::cli
