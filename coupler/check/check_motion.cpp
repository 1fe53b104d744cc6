#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/angles.hpp"
#include "common/input_error.hpp"
#include "common/seconds.hpp"
#include "coupler/check/check_parts.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/machine_geometry.hpp"

namespace fs = std::filesystem;

namespace dipper::check {
namespace {

// Between two samples a tooth at 5 m/s (full swing) moves 0.1 m, but where it is farthest out it
// turns back: there the error is 1/8 of acceleration times the sample squared, below a millimetre.
constexpr std::int64_t sample_ns = 20'000'000;

template <class Load>
auto load_reported(const cases::Case& c, const std::string& key, const fs::path& file,
                   const Load& load, Findings& findings) -> std::optional<decltype(load(file))> {
  if (!file_exists(c, key, file, findings)) return std::nullopt;
  try {
    return load(file);
  } catch (const InputError& e) {
    cases::add_file_findings(c, key, e, findings);
  }
  return std::nullopt;
}

// How far one body has been outside of one side of the domain.
struct Excursion {
  double first_s = -1;  // -1: never
  double worst_s = 0;
  double worst = 0;  // coordinate, m
  double beyond = 0;

  void see(double coordinate, double outside_by, double t_s) {
    if (outside_by <= 0) return;
    if (first_s < 0) first_s = t_s;
    if (outside_by <= beyond) return;
    worst_s = t_s;
    worst = coordinate;
    beyond = outside_by;
  }
};

void check_bodies_in_domain(const cases::Case& c, const machine::ShovelKinematics& shovel,
                            const machine::Motion& motion,
                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                            Findings& findings) {
  std::map<std::string, std::array<Excursion, 6>> excursions;  // xyz of min_m, then of max_m
  std::map<std::string, double> reach;  // m from a body's origin to its farthest vertex
  for (const auto& [name, body] : bodies) {
    for (const Eigen::Vector3d& p_B : body.vertices) {
      reach[name] = std::max(reach[name], p_B.norm());
    }
  }
  const std::int64_t end = motion.end_ns();
  for (std::int64_t t = motion.start_ns();; t = std::min(t + sample_ns, end)) {
    machine::ShovelPose pose;
    try {
      pose = shovel.pose(motion.value(t));
    } catch (const std::domain_error&) {  // beyond the ropes: ShovelKinematics::check tells
      if (t == end) break;
      continue;
    }
    for (const auto& [name, body] : bodies) {
      const Pose& X = name == "door" ? pose.X_WD : pose.X_WB;
      // Most of the time the whole body is far from every side, whichever way it is turned.
      const double room =
          std::min((X.p - c.domain.min_m).minCoeff(), (c.domain.max_m - X.p).minCoeff());
      if (room > reach[name]) continue;
      const Eigen::Matrix3d R = X.R.toRotationMatrix();
      auto& sides = excursions[name];
      for (const Eigen::Vector3d& p_B : body.vertices) {
        const Eigen::Vector3d p_W = X.p + R * p_B;
        for (int i = 0; i < 3; ++i) {
          sides[i].see(p_W[i], c.domain.min_m[i] - p_W[i], seconds(t));
          sides[i + 3].see(p_W[i], p_W[i] - c.domain.max_m[i], seconds(t));
        }
      }
    }
    if (t == end) break;
  }
  for (const auto& [name, sides] : excursions) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const Excursion& e = sides[i];
      if (e.first_s < 0) continue;
      const bool low = i < 3;
      findings.push_back(cases::finding_at(
          c, low ? "domain.min_m" : "domain.max_m",
          fmt::format("the {} leaves the domain at {:.2f} s; at {:.2f} s it reaches {} = {:.4g} m, "
                      "{:.3g} m outside {:g}",
                      name, e.first_s, e.worst_s, "xyz"[i % 3], e.worst, e.beyond,
                      (low ? c.domain.min_m : c.domain.max_m)[static_cast<int>(i % 3)])));
    }
  }
}

// What happens at the motion's times has none where limited drives come later.
void check_times_of_motion(const cases::Case& c, Findings& findings) {
  if (c.machine.drives != machine::DriveMode::limited) return;
  if (c.collapse.height_m > 0 && c.collapse.at_s == 0) {
    findings.push_back(cases::finding_at(
        c, "collapse.at_s", "limited drives do not keep the motion's times; write a time"));
  }
}

// The floor is cleaned as a way back without rock ends, and at no other time.
void check_clean_floor(const cases::Case& c, Findings& findings) {
  if (c.pile.clean_floor_to_x_m == 0 || !c.machine.contact_on_return) return;
  findings.push_back(
      cases::finding_at(c, "pile.clean_floor_to_x_m",
                        "needs a return without rock; write machine.contact_on_return: off"));
}

}  // namespace

std::optional<machine::Motion> check_motion(const cases::Case& c,
                                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                                            Findings& findings) {
  std::map<std::string, mesh::TriangleMesh> known = bodies;
  for (const auto& body : c.bodies) {
    if (body.first == "dipper" || body.first == "door") continue;
    known.erase(body.first);
    findings.push_back(cases::finding_at(c, "bodies." + body.first,
                                         "the machine has no such body; it has dipper and door"));
  }
  if (!c.bodies.count("dipper"))
    findings.push_back(cases::finding_at(c, "bodies.dipper", "missing key; it is what digs"));
  if (!c.bodies.count("door"))
    findings.push_back(
        cases::finding_at(c, "bodies.door", "missing key; without it the dipper holds nothing"));

  const auto machine =
      load_reported(c, "machine.model", c.machine.model, machine::load_machine, findings);
  auto motion =
      load_reported(c, "machine.motion", c.machine.motion, &machine::Motion::load, findings);
  if (machine) {
    const auto faults = machine::geometry_faults(*machine, radians(c.machine.rake_angle_deg));
    for (const std::string& fault : faults)
      findings.push_back({c.machine.model, 0, "machine.model", fault});
    if (!faults.empty()) return motion;
  }
  if (!machine || !motion) return motion;

  const Pose X_W0{Quaterniond::Identity(), c.machine.base_position_m};
  const machine::ShovelKinematics shovel(*machine, X_W0, radians(c.machine.rake_angle_deg));
  for (const std::string& message : shovel.check(*motion)) {
    findings.push_back({c.machine.motion, 0, "machine.motion", message});
  }
  check_bodies_in_domain(c, shovel, *motion, known, findings);
  check_times_of_motion(c, findings);
  check_clean_floor(c, findings);
  check_collapse(c, shovel, *motion, known, findings);
  return motion;
}

void check_windows(const cases::Case& c, const machine::Motion& motion, Findings& findings) {
  // Time is a whole number of nanoseconds and of steps; a step between two would drift from it.
  const double step_ns = c.dem.timestep_s * 1e9;
  if (std::abs(step_ns - std::round(step_ns)) > 1e-3 || step_ns < 0.5) {
    findings.push_back(cases::finding_at(
        c, "dem.timestep_s",
        fmt::format("{:g} is not a whole number of nanoseconds; write {:.9g}", c.dem.timestep_s,
                    std::max(1.0, std::floor(step_ns)) * 1e-9)));
  }
  if (c.end_s > 0 && c.end_s <= seconds(motion.start_ns())) {
    findings.push_back(
        cases::finding_at(c, "end_s",
                          fmt::format("{:g} s is before the motion starts, at {:g} s", c.end_s,
                                      seconds(motion.start_ns()))));
  }
  const double end_s = c.end_s > 0 ? c.end_s : seconds(motion.end_ns());
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  if (window_s > end_s) {
    findings.push_back(cases::finding_at(
        c, "coupling.sync_steps",
        fmt::format(
            "a sync step of {} DEM steps takes {:g} s, longer than the {:g} s simulated; write at "
            "most {:.0f}",
            c.coupling.sync_steps, window_s, end_s,
            std::max(1.0, std::floor(end_s / c.dem.timestep_s)))));
  }
}

}  // namespace dipper::check
