#include <cmath>

#include "analysis/io/line_reader.hpp"
#include "analysis/run/run_folder.hpp"
#include "common/record/record.hpp"

namespace dipper::analysis::run {
namespace {

namespace fs = std::filesystem;

rock::PoseTrack read_track(const fs::path& record, const std::string& body,
                           const std::vector<double>& time_s) {
  std::array<std::vector<double>, 7> pose;
  std::array<std::vector<double>, 6> twist;
  for (std::size_t k = 0; k < pose.size(); ++k)
    pose[k] = record::read_channel(record, "bodies/" + body + "/wall_pose", k);
  for (std::size_t k = 0; k < twist.size(); ++k)
    twist[k] = record::read_channel(record, "bodies/" + body + "/twist", k);
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

}  // namespace

RunSignals read_signals(const fs::path& record) {
  RunSignals s;
  const auto channel = [&](const std::string& name, std::size_t column = 0) {
    return record::read_channel(record, name, column);
  };
  try {
    signals::PassSignals& p = s.pass;
    p.time_s = channel("time_s");
    p.door_rad = channel("machine/door");
    p.hoist_force_N = channel("machine/hoist_force");
    p.crowd_force_N = channel("machine/crowd_force");
    p.dipper_mass_kg = channel("rock/mass_in_dipper");
    p.truck_mass_kg = channel("rock/mass_in_truck");
    const auto fx = channel("bodies/dipper/wrench_mean", 3),
               fy = channel("bodies/dipper/wrench_mean", 4),
               fz = channel("bodies/dipper/wrench_mean", 5),
               door_fz = channel("bodies/door/wrench_mean", 5);
    for (std::size_t i = 0; i < fx.size(); ++i) {
      p.dipper_force_N.push_back(std::hypot(fx[i], fy[i], fz[i]));
      s.weight_N.push_back(-fz[i] - door_fz[i]);
    }
    s.drive.time_s = p.time_s;
    s.drive.crowd_m = channel("machine/crowd");
    s.drive.swing_rad = channel("machine/swing");
    s.hoist_power_W = channel("machine/hoist_power");
    s.crowd_power_W = channel("machine/crowd_power");
    s.swing_power_W = channel("machine/swing_power");
    s.rock_work_J = channel("coupling/rock_work");
    s.rock_kg = channel("rock/rock_mass");
    for (const char* body : {"dipper", "door"}) s.walls[body] = read_track(record, body, p.time_s);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw io::input_error(record, 0, e.what());
  }
  if (s.pass.time_s.size() < 2)
    throw io::input_error(record, 0, "fewer than two rows: the run ended before it began");
  return s;
}

}  // namespace dipper::analysis::run
