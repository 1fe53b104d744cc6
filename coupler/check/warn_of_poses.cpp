#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/angles.hpp"
#include "common/seconds.hpp"
#include "coupler/check/warning_parts.hpp"
#include "machine/pose_table.hpp"

namespace dipper::check {
namespace {

using Rows = std::vector<machine::PoseTable::Row>;

constexpr double kFastest_m_s = 20;     // no tool that digs is so fast
constexpr double kUsualRow_s = 60;      // rows further apart, as a rule: times in ms
constexpr double kFarthestTurn = 0.9;   // of half a turn; beyond that the shorter way is another
constexpr double kHalfTurned = 0.7072;  // a little over qz of a body turned by 90 degrees about z
constexpr double kMostRows = 0.75;      // a body that digs is tilted beyond 90 degrees in few

// The first rows between which a body is too fast, or turns so far that either way may be meant.
void warn_of_steps(const cases::Case& c, const std::string& body, const Rows& rows,
                   std::vector<Finding>& warnings) {
  bool fast = false, far = false;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto &a = rows[i - 1], &b = rows[i];
    const double h = seconds(b.t_ns - a.t_ns);
    const Twist mean = twist_between(a.X_WB, b.X_WB, h);
    if (!fast && mean.v.norm() > kFastest_m_s) {
      fast = true;
      warnings.push_back(
          {c.machine.poses, b.line, "machine.poses",
           fmt::format("{} moves {:.3g} m in {:.3g} s, {:.3g} m/s: a wrong row, or another unit?",
                       body, h * mean.v.norm(), h, mean.v.norm())});
    }
    if (!far && h * mean.w.norm() > kFarthestTurn * M_PI) {
      far = true;
      warnings.push_back(
          {c.machine.poses, b.line, "machine.poses",
           fmt::format("{} turns by {:.0f} degrees from one row to the next, the shorter way: is "
                       "that meant? write rows between them",
                       body, degrees(h * mean.w.norm()))});
    }
  }
}

// A body is rarely turned back most of the time; with the scalar last one that is hardly turned is.
std::size_t count_turned_back(const Rows& rows) {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const auto& row) {
    return std::abs(row.X_WB.R.z()) > kHalfTurned;
  }));
}

}  // namespace

void warn_of_poses(const cases::Case& c, std::vector<Finding>& warnings) {
  const machine::PoseTable table = machine::PoseTable::load(c.machine.poses);
  std::vector<double> steps_s;
  double first_s = INFINITY;
  std::size_t turned_back = 0, all = 0;
  for (const std::string& body : table.bodies()) {
    const Rows& rows = table.rows(body);
    first_s = std::min(first_s, seconds(rows.front().t_ns));
    turned_back += count_turned_back(rows);
    all += rows.size();
    for (std::size_t i = 1; i < rows.size(); ++i)
      steps_s.push_back(seconds(rows[i].t_ns - rows[i - 1].t_ns));
    warn_of_steps(c, body, rows, warnings);
  }
  const auto say = [&](const std::string& what) {
    warnings.push_back({c.machine.poses, 0, "machine.poses", what});
  };
  if (static_cast<double>(turned_back) > kMostRows * static_cast<double>(all))
    say(fmt::format(
        "qz is the largest of qw,qx,qy,qz in {} of {} rows, so that x points back: is the scalar "
        "last? name the columns in the order in which they stand, as in qx,qy,qz,qw",
        turned_back, all));
  if (!steps_s.empty()) {
    const auto middle = steps_s.begin() + static_cast<long>(steps_s.size() / 2);
    std::nth_element(steps_s.begin(), middle, steps_s.end());
    if (*middle > kUsualRow_s)
      say(fmt::format("time_s has a row every {:g} s: in ms, perhaps?", *middle));
  }
  if (first_s != 0)
    say(fmt::format(
        "the first row is at {:g} s; the run begins at 0 s, {}", first_s,
        first_s < 0 ? "so what is before is left out" : "and nothing moves until then"));
}

}  // namespace dipper::check
