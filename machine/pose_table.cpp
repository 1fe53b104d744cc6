#include "machine/pose_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "machine/monotone_slope.hpp"

namespace dipper::machine {
namespace {

constexpr double kFarthest = 1e6;   // m, s
constexpr double kUnitNorm = 1e-3;  // of a quaternion's length, which tables round

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
  std::vector<Finding> faults;
  const auto fault = [&](int line, const std::string& message) {
    faults.push_back({file, line, "", message, 1});
  };
  const std::vector<std::string> columns = {"time_s", "body", "x_m", "y_m", "z_m",
                                            "qw",     "qx",   "qy",  "qz"};
  for (const CsvRow& row : read_csv(file, columns, faults, "body")) {
    const auto& v = row.values;
    Track& track = table.tracks_[row.name];
    const Vector3d p(v[2], v[3], v[4]);
    const Quaterniond R(v[5], v[6], v[7], v[8]);
    if (std::abs(v[0]) > kFarthest || p.cwiseAbs().maxCoeff() > kFarthest) {
      fault(row.line, fmt::format("times and positions must be within {:g} s and m", kFarthest));
    } else if (std::abs(R.norm() - 1) > kUnitNorm) {
      fault(row.line,
            fmt::format("qw,qx,qy,qz is not a rotation: its length is {:.4g}; it must be 1",
                        R.norm()));
    } else if (const std::int64_t t = std::llround(v[0] * 1e9);
               !track.t_ns.empty() && t <= track.t_ns.back()) {
      fault(row.line, fmt::format("time_s is {:g}, not after the previous row of {} ({:g} s)", v[0],
                                  row.name, seconds(track.t_ns.back())));
    } else {
      track.t_ns.push_back(t);
      track.X_WB.push_back({R.normalized(), p});
    }
  }
  if (faults.empty() && table.tracks_.empty()) fault(0, "no rows; write one or more for each body");
  sort_by_line(faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  for (auto& track : table.tracks_) set_slopes(track.second);
  return table;
}

void PoseTable::set_slopes(Track& track) {
  const std::size_t n = track.t_ns.size();
  track.V_WB_W.assign(n, {});
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = seconds(track.t_ns[i] - track.t_ns[i - 1]);
    const double h1 = seconds(track.t_ns[i + 1] - track.t_ns[i]);
    const Twist before = twist_between(track.X_WB[i - 1], track.X_WB[i], h0);
    const Twist after = twist_between(track.X_WB[i], track.X_WB[i + 1], h1);
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
  const auto next = std::upper_bound(track.t_ns.begin(), track.t_ns.end(), t_ns);
  if (next == track.t_ns.begin()) return {track.X_WB.front(), {}};
  if (next == track.t_ns.end()) return {track.X_WB.back(), {}};
  const auto i = static_cast<std::size_t>(next - track.t_ns.begin());
  const Pose &a = track.X_WB[i - 1], &b = track.X_WB[i];
  const Twist &Va = track.V_WB_W[i - 1], &Vb = track.V_WB_W[i];
  const double h = seconds(track.t_ns[i] - track.t_ns[i - 1]);
  const double s = seconds(t_ns - track.t_ns[i - 1]) / h;
  const Twist mean = twist_between(a, b, h);
  const Cubic p = cubic(s, b.p - a.p, h * Va.v, h * Vb.v);
  const Cubic r = cubic(s, h * mean.w, h * Va.w, h * Vb.w);
  return {{from_rotation_vector(r.value) * a.R, a.p + p.value},
          {angular_velocity(r.value, r.slope) / h, p.slope / h}};
}

std::int64_t PoseTable::end_ns() const {
  std::int64_t end = 0;
  for (const auto& track : tracks_) end = std::max(end, track.second.t_ns.back());
  return end;
}

}  // namespace dipper::machine
