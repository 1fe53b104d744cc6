#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/seconds.hpp"
#include "coupler/check/check_parts.hpp"
#include "coupler/deck/collapse.hpp"
#include "coupler/deck/contact_table.hpp"

namespace dipper::check {
namespace {

const std::string kHeight = "collapse.height_m", kTime = "collapse.at_s";

void check_slab(const cases::Case& c, const deck::CollapseSlab& slab, Findings& findings) {
  double heaviest = 0;
  for (const deck::RockClass& rock : deck::rock_classes(c))
    heaviest = std::max(heaviest, rock.mass_kg);
  if (slab.mass_kg < heaviest) {
    findings.push_back(cases::finding_at(
        c, kHeight,
        fmt::format(
            "a slab of {:g} m weighs {:.2g} t, less than one rock of {:.2g} t; write at least "
            "{:.2g}, or 0",
            c.collapse.height_m, slab.mass_kg / 1000, heaviest / 1000,
            c.collapse.height_m * heaviest / slab.mass_kg)));
  }
  if (slab.top_m > c.domain.max_m.z()) {
    findings.push_back(cases::finding_at(
        c, kHeight,
        fmt::format(
            "the slab reaches z = {:.4g} m when it comes loose, above domain.max_m ({:g} m)",
            slab.top_m, c.domain.max_m.z())));
  }
}

/// Rock that appears inside a body would be thrown out at high speed.
void check_clear(const cases::Case& c, const deck::CollapseSlab& slab, double at_s,
                 const machine::ShovelKinematics& shovel, const machine::Motion& motion,
                 const std::map<std::string, mesh::TriangleMesh>& bodies, Findings& findings) {
  constexpr double kMargin_m = 0.5;  // facets are up to 1 m long between the corners looked at
  const double slope = (slab.crest_z_m - slab.foot_z_m) / (slab.crest_x_m - slab.face_x_m);
  const double loose = slab.top_m - slab.crest_z_m;
  const auto in_slab_or_bench = [&](const Eigen::Vector3d& p) {
    const double face = slab.foot_z_m + slope * (p.x() - slab.face_x_m);
    return p.x() > slab.face_x_m - kMargin_m && p.x() < slab.rear_x_m + kMargin_m &&
           std::abs(p.y()) < c.pile.width_m / 2 + kMargin_m &&
           p.z() < std::min(face, slab.crest_z_m) + loose + kMargin_m;
  };
  machine::ShovelPose pose;
  try {
    pose = shovel.pose(motion.value(std::llround(at_s * 1e9)));
  } catch (const std::domain_error&) {  // beyond the ropes: ShovelKinematics::check reports it
    return;
  }
  for (const auto& [name, body] : bodies) {
    const Pose& X = name == "door" ? pose.X_WD : pose.X_WB;
    if (std::none_of(body.vertices.begin(), body.vertices.end(),
                     [&](const Eigen::Vector3d& p_B) { return in_slab_or_bench(X * p_B); })) {
      continue;
    }
    findings.push_back(cases::finding_at(c, kTime,
                                         fmt::format("at {:.2f} s the {} is where the slab comes "
                                                     "down; write a time at which it is away from "
                                                     "the bench, over the truck",
                                                     at_s, name)));
  }
}

}  // namespace

void check_collapse(const cases::Case& c, const machine::ShovelKinematics& shovel,
                    const machine::Motion& motion,
                    const std::map<std::string, mesh::TriangleMesh>& bodies, Findings& findings) {
  if (c.collapse.height_m == 0) return;
  deck::CollapseSlab slab;
  try {
    slab = deck::collapse_slab(c);
  } catch (const std::invalid_argument&) {  // a class of mixed shapes: check_rock reports it
    return;
  }
  check_slab(c, slab, findings);
  // Nobody knows yet how long the passes of an operator who plans take, or where the dipper is
  // then.
  if (c.machine.operated_by == cases::OperatorKind::plan) return;
  const auto at_s = deck::collapse_time_s(c, motion);
  if (!at_s) {
    findings.push_back(cases::finding_at(
        c, kTime, "the motion never opens the door; write the time at which the slab comes down"));
    return;
  }
  // A shorter end_s is taken as intended.
  if (const double end_s = seconds(motion.end_ns()); *at_s >= end_s) {
    findings.push_back(cases::finding_at(
        c, kTime,
        fmt::format("{:g} s is not before the end of the motion, {:.2f} s", *at_s, end_s)));
  }
  check_clear(c, slab, *at_s, shovel, motion, bodies, findings);
}

}  // namespace dipper::check
