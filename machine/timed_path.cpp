#include "machine/timed_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"
#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "machine/motion_row.hpp"

namespace dipper::machine {
namespace {

const std::vector<std::string> kPathColumns = {"x_m",    "z_m",       "speed_m_s",
                                               "wait_s", "swing_deg", "door_deg"};
constexpr double kSample_s = 0.2;  // between rows of the motion
constexpr double kSame_m = 1e-6;   // points nearer than this are one

Vector2d tip_of(const CsvRow& row) { return {row.values[0], row.values[1]}; }

bool stands(const CsvRow& row, const CsvRow& before) {
  return (tip_of(row) - tip_of(before)).norm() < kSame_m;
}

/// What is wrong with a row; empty: nothing.
std::string fault_of(const std::vector<CsvRow>& rows, std::size_t i) {
  const double speed = rows[i].values[2], wait = rows[i].values[3];
  if (speed < 0) return fmt::format("speed_m_s is {}; write 0 or more", speed);
  if (wait < 0) return fmt::format("wait_s is {}; write 0 or more", wait);
  if ((i == 0 || i + 1 == rows.size()) && speed > 0)
    return fmt::format("speed_m_s is {}; a motion begins and ends at rest, write 0", speed);
  if (i == 0) return wait > 0 ? "wait_s is for a row that repeats the previous point; write 0" : "";
  const double before = rows[i - 1].values[2];
  if (!stands(rows[i], rows[i - 1])) {
    if (wait > 0)
      return fmt::format("wait_s is {}, but the teeth move; repeat the point to wait there", wait);
    if (speed + before <= 0)
      return "speed_m_s is 0 here and in the previous row; the teeth would never arrive";
    return "";
  }
  if (speed + before > 0)
    return "repeats the point; speed_m_s must be 0 here and in the previous row";
  return wait > 0 ? "" : "repeats the point; write the waiting time in wait_s";
}

/// The paths between the points, one curve for each stretch between two stops.
std::vector<TeethPath> legs_of(const std::vector<PathPoint>& points) {
  std::vector<TeethPath> legs;
  TeethPath stretch(1, points.front().tip);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if ((points[i].tip - points[i - 1].tip).norm() < kSame_m) {
      legs.push_back(TeethPath(2, points[i].tip));
      continue;
    }
    stretch.push_back(points[i].tip);
    if (points[i].speed_m_s > 0) continue;
    for (TeethPath& leg : legs_through(stretch)) legs.push_back(std::move(leg));
    stretch.assign(1, points[i].tip);
  }
  return legs;
}

}  // namespace

TimedPath read_timed_path(const std::filesystem::path& file) {
  std::vector<Finding> findings;
  const std::vector<CsvRow> rows = read_csv(file, kPathColumns, findings);
  if (findings.empty() && rows.size() < 2)
    findings.push_back({file, 0, "", fmt::format("{} row(s); a path needs 2", rows.size())});
  if (findings.empty())
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (const std::string fault = fault_of(rows, i); !fault.empty())
        findings.push_back({file, rows[i].line, "", fault, 1});
  if (!findings.empty()) throw InputError(std::move(findings));

  TimedPath path;
  for (const CsvRow& row : rows)
    path.points.push_back(
        {0, tip_of(row), row.values[2], radians(row.values[4]), radians(row.values[5])});
  path.legs = legs_of(path.points);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const PathPoint& from = path.points[i - 1];
    PathPoint& to = path.points[i];
    to.t_s = from.t_s + (stands(rows[i], rows[i - 1])
                             ? rows[i].values[3]
                             : 2 * length(path.legs[i - 1]) / (from.speed_m_s + to.speed_m_s));
  }
  return path;
}

std::string motion_rows(const TimedPath& path, const ShovelKinematics& shovel) {
  std::string turns = kMotionHead;
  for (const PathPoint& p : path.points)
    turns +=
        fmt::format("{:.9f},0,0,{:.9f},{:.9f}\n", p.t_s, degrees(p.swing_rad), degrees(p.door_rad));
  const Motion house_and_door = Motion::parse(turns, "the path's swing and door");
  std::string rows;
  std::size_t leg = 0;
  const auto n = static_cast<int>(std::ceil(path.points.back().t_s / kSample_s - 1e-9));
  for (int i = 0; i <= n; ++i) {
    const double t = i * kSample_s;
    while (leg + 1 < path.legs.size() && t >= path.points[leg + 1].t_s) ++leg;
    const PathPoint &from = path.points[leg], &to = path.points[leg + 1];
    const double share = std::min((t - from.t_s) / (to.t_s - from.t_s), 1.0);
    // Distance at constant acceleration, over the whole distance.
    const double mean = (from.speed_m_s + to.speed_m_s) / 2;
    const double gone =
        mean > 0 ? share * (from.speed_m_s + share * (to.speed_m_s - from.speed_m_s) / 2) / mean
                 : 0;
    const Drives turned = house_and_door.at(t).position;
    rows += motion_row(t, at_fraction(path.legs[leg], gone), turned.swing, turned.door, shovel);
  }
  return rows;
}

}  // namespace dipper::machine
