#include "machine/pose_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "common/row_faults.hpp"
#include "common/seconds.hpp"
#include "machine/monotone_slope.hpp"

namespace dipper::machine {
namespace {

constexpr double kLastTime_s = 1e4;  // as of a motion
constexpr double kFarthest_m = 1e5;  // a mine's coordinates are farther
constexpr double kUnitNorm = 1e-3;   // of a quaternion's length, which tables round

/// A cubic from 0 to d at s in 0 ... 1, with the slopes given per unit of s.
struct Cubic {
  Vector3d value, slope;
};
Cubic cubic(double s, const Vector3d& d, const Vector3d& m0, const Vector3d& m1) {
  const Vector3d c2 = 3 * d - 2 * m0 - m1, c3 = m0 + m1 - 2 * d;
  return {s * (m0 + s * (c2 + s * c3)), m0 + s * (2 * c2 + s * 3 * c3)};
}

/// The angular velocity of exp(r) as r changes at the rate v, in the axes that r is in.
Vector3d angular_velocity(const Vector3d& r, const Vector3d& v) {
  const double angle = r.norm();
  if (angle < 1e-6) return v + 0.5 * r.cross(v);
  return v + (1 - std::cos(angle)) / (angle * angle) * r.cross(v) +
         (angle - std::sin(angle)) / (angle * angle * angle) * r.cross(r.cross(v));
}

}  // namespace

PoseTable PoseTable::load(const std::filesystem::path& file) {
  PoseTable table;
  std::vector<Finding> findings;
  RowFaults faults;
  const std::vector<std::string> columns = {"time_s", "body", "x_m", "y_m", "z_m",
                                            "qw",     "qx",   "qy",  "qz"};
  for (const CsvRow& row : read_csv(file, columns, findings, "body")) {
    const auto& v = row.values;
    const auto fault = [&](const std::string& kind, const std::string& wrong,
                           const std::string& right) {
      faults.add(kind, row.line, 1, wrong, right);
    };
    const Vector3d p(v[2], v[3], v[4]);
    const Quaterniond R(v[5], v[6], v[7], v[8]);
    if (row.name.empty()) {
      fault("body", "body is empty", "it must be one of the bodies of the case");
      continue;
    }
    std::vector<Row>& rows = table.tracks_[row.name].rows;
    if (std::abs(v[0]) > kLastTime_s) {
      fault(
          "time", fmt::format("time_s is {}", v[0]),
          fmt::format("it must be within {:g} s, where 0 is where the run begins: in ms, or a time "
                      "stamp, perhaps?",
                      kLastTime_s));
    } else if (p.cwiseAbs().maxCoeff() > kFarthest_m) {
      fault("position", fmt::format("x_m,y_m,z_m is {},{},{}", p.x(), p.y(), p.z()),
            fmt::format(
                "each must be within {:g} m, in W, as the case: in the mine's coordinates, or "
                "in mm, perhaps?",
                kFarthest_m));
    } else if (std::abs(R.norm() - 1) > kUnitNorm) {
      fault("quaternion",
            fmt::format("qw,qx,qy,qz is not a rotation: its length is {:.4g}", R.norm()),
            fmt::format("it must be 1 within {:g}: a unit quaternion, no angles", kUnitNorm));
    } else if (const std::int64_t t = std::llround(v[0] * 1e9);
               !rows.empty() && t <= rows.back().t_ns) {
      fault("order",
            fmt::format("time_s is {}, not after the previous row of {} ({} s)", v[0], row.name,
                        seconds(rows.back().t_ns)),
            "the times of each body must rise");
    } else {
      rows.push_back({t, {R.normalized(), p}, row.line});
    }
  }
  faults.report(file, findings);
  if (findings.empty() && table.tracks_.empty())
    findings.push_back({file, 0, "", "no rows; write one or more for each body", 1});
  sort_by_line(findings);
  if (!findings.empty()) throw InputError(std::move(findings));
  for (auto& track : table.tracks_) set_slopes(track.second);
  return table;
}

void PoseTable::set_slopes(Track& track) {
  const std::size_t n = track.rows.size();
  track.V_WB_W.assign(n, {});
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Row &a = track.rows[i - 1], &b = track.rows[i], &c = track.rows[i + 1];
    const double h0 = seconds(b.t_ns - a.t_ns);
    const double h1 = seconds(c.t_ns - b.t_ns);
    const Twist before = twist_between(a.X_WB, b.X_WB, h0);
    const Twist after = twist_between(b.X_WB, c.X_WB, h1);
    for (int k = 0; k < 3; ++k) {
      track.V_WB_W[i].v[k] = monotone_slope(h0, before.v[k], h1, after.v[k]);
      track.V_WB_W[i].w[k] = monotone_slope(h0, before.w[k], h1, after.w[k]);
    }
  }
}

std::vector<std::string> PoseTable::bodies() const {
  std::vector<std::string> names;
  for (const auto& track : tracks_) names.push_back(track.first);
  return names;
}

BodyState PoseTable::at(const std::string& body, std::int64_t t_ns) const {
  const Track& track = tracks_.at(body);
  const auto next = std::upper_bound(track.rows.begin(), track.rows.end(), t_ns,
                                     [](std::int64_t t, const Row& row) { return t < row.t_ns; });
  if (next == track.rows.begin()) return {track.rows.front().X_WB, {}};
  if (next == track.rows.end()) return {track.rows.back().X_WB, {}};
  const auto i = static_cast<std::size_t>(next - track.rows.begin());
  const Pose &a = track.rows[i - 1].X_WB, &b = track.rows[i].X_WB;
  const Twist &Va = track.V_WB_W[i - 1], &Vb = track.V_WB_W[i];
  const double h = seconds(track.rows[i].t_ns - track.rows[i - 1].t_ns);
  const double s = seconds(t_ns - track.rows[i - 1].t_ns) / h;
  const Twist mean = twist_between(a, b, h);
  const Cubic p = cubic(s, b.p - a.p, h * Va.v, h * Vb.v);
  const Cubic r = cubic(s, h * mean.w, h * Va.w, h * Vb.w);
  return {{from_rotation_vector(r.value) * a.R, a.p + p.value},
          {angular_velocity(r.value, r.slope) / h, p.slope / h}};
}

std::int64_t PoseTable::end_ns() const {
  std::int64_t end = 0;
  for (const auto& track : tracks_) end = std::max(end, track.second.rows.back().t_ns);
  return end;
}

}  // namespace dipper::machine
