#include <array>
#include <cmath>

#include "analysis/io/line_reader.hpp"
#include "analysis/run/run_folder.hpp"
#include "common/record/columns.hpp"

namespace dipper::analysis::run {
namespace {

namespace fs = std::filesystem;
using Column = std::vector<double>;

constexpr std::array<const char*, 2> kBodies = {"dipper", "door"};

record::Columns read_drives(const fs::path& record) {
  record::Columns c(record);
  for (const char* channel :
       {"time_s", "machine/door", "machine/hoist", "machine/crowd", "machine/swing",
        "machine/hoist_force", "machine/crowd_force", "machine/rope_tension_left",
        "machine/rope_tension_right", "machine/hoist_power", "machine/crowd_power",
        "machine/swing_power", "rock/mass_in_dipper", "rock/mass_in_truck"})
    c.read(channel);
  for (std::size_t k = 3; k < 6; ++k) c.read("bodies/dipper/wrench_mean", k);
  return c;
}

void read_track(record::Columns& c, const std::string& body) {
  for (std::size_t k = 0; k < 7; ++k) c.read("bodies/" + body + "/wall_pose", k);
  for (std::size_t k = 0; k < 6; ++k) c.read("bodies/" + body + "/twist", k);
}

record::Columns read_columns(const fs::path& record) {
  record::Columns c = read_drives(record);
  for (const char* channel : {"rock/rock_mass", "coupling/rock_work"}) c.read(channel);
  c.read("bodies/door/wrench_mean", 5);
  for (const char* body : kBodies) read_track(c, body);
  return c;
}

rock::PoseTrack track_of(const record::Columns& c, const std::string& body) {
  std::array<Column, 7> pose;
  std::array<Column, 6> twist;
  for (std::size_t k = 0; k < pose.size(); ++k) pose[k] = c.get("bodies/" + body + "/wall_pose", k);
  for (std::size_t k = 0; k < twist.size(); ++k) twist[k] = c.get("bodies/" + body + "/twist", k);
  const Column time_s = c.get("time_s");
  std::vector<Pose> X_WB;
  std::vector<Twist> V_WB_W;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    X_WB.push_back({Quaterniond(pose[3][i], pose[4][i], pose[5][i], pose[6][i]).normalized(),
                    {pose[0][i], pose[1][i], pose[2][i]}});
    V_WB_W.push_back(
        {{twist[0][i], twist[1][i], twist[2][i]}, {twist[3][i], twist[4][i], twist[5][i]}});
  }
  return {time_s, X_WB, V_WB_W};
}

RunSignals drives_of(const record::Columns& c) {
  RunSignals s;
  signals::PassSignals& p = s.pass;
  p.time_s = c.get("time_s");
  p.door_rad = c.get("machine/door");
  p.hoist_force_N = c.get("machine/hoist_force");
  p.crowd_force_N = c.get("machine/crowd_force");
  const Column left_N = c.get("machine/rope_tension_left"),
               right_N = c.get("machine/rope_tension_right");
  for (std::size_t i = 0; i < left_N.size(); ++i)
    p.rope_tension_N.push_back(left_N[i] + right_N[i]);
  p.dipper_mass_kg = c.get("rock/mass_in_dipper");
  p.truck_mass_kg = c.get("rock/mass_in_truck");
  const Column fx = c.get("bodies/dipper/wrench_mean", 3),
               fy = c.get("bodies/dipper/wrench_mean", 4),
               fz = c.get("bodies/dipper/wrench_mean", 5);
  for (std::size_t i = 0; i < fx.size(); ++i)
    p.dipper_force_N.push_back(std::hypot(fx[i], fy[i], fz[i]));
  s.drive = {p.time_s,
             c.get("machine/hoist"),
             c.get("machine/crowd"),
             c.get("machine/swing"),
             p.hoist_force_N,
             p.crowd_force_N,
             c.get("machine/hoist_power"),
             c.get("machine/crowd_power"),
             c.get("machine/swing_power")};
  return s;
}

RunSignals signals_of(const record::Columns& c) {
  RunSignals s = drives_of(c);
  const Column dipper_fz = c.get("bodies/dipper/wrench_mean", 5),
               door_fz = c.get("bodies/door/wrench_mean", 5);
  for (std::size_t i = 0; i < door_fz.size(); ++i) s.weight_N.push_back(-dipper_fz[i] - door_fz[i]);
  s.rock_work_J = c.get("coupling/rock_work");
  s.rock_kg = c.get("rock/rock_mass");
  for (const char* body : kBodies) s.walls[body] = track_of(c, body);
  return s;
}

RunSignals require_rows(RunSignals s, const fs::path& record) {
  if (s.pass.time_s.size() < 2)
    throw io::input_error(record, 0, "fewer than two rows: the run ended before it began");
  return s;
}

}  // namespace

RunSignals read_drive_signals(const fs::path& record) { return drives_of(read_drives(record)); }

RunSignals read_body_signals(const fs::path& record, const std::vector<std::string>& bodies) {
  record::Columns c(record);
  for (const char* channel : {"time_s", "rock/rock_mass", "coupling/rock_work"}) c.read(channel);
  for (const std::string& body : bodies) read_track(c, body);
  RunSignals s;
  s.pass.time_s = c.get("time_s");
  s.rock_work_J = c.get("coupling/rock_work");
  s.rock_kg = c.get("rock/rock_mass");
  for (const std::string& body : bodies) s.walls[body] = track_of(c, body);
  return require_rows(std::move(s), record);
}

RunSignals read_signals(const fs::path& record) {
  return require_rows(signals_of(read_columns(record)), record);
}

}  // namespace dipper::analysis::run
