#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"
#include "common/mesh/insides.hpp"
#include "common/mesh/signed_distance.hpp"
#include "common/seconds.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/case/outline_file.hpp"
#include "coupler/check/warning_parts.hpp"
#include "coupler/deck/pile_shape.hpp"
#include "machine/door.hpp"
#include "machine/return_legs.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::check {
namespace {

constexpr double kDeep_m = 0.1;                   ///< more overlap than facets can cause
constexpr double kClosed_m = 0.05;                ///< heel below the path of the teeth, at most
constexpr double kSunk_m = 0.1, kWheels_m = 3.0;  ///< of a truck's mesh, under and over the ground
constexpr double kNearGround_m = 1.0;             ///< above that, rock can give way
constexpr double kTurning_rad_s = 0.02;           ///< a swing that has not ended
constexpr std::int64_t kPlaceSample_ns = 100'000'000;  ///< the dipper goes some 0.3 m meanwhile

/// Height of the bench's surface; the ground's 0 elsewhere.
class Bench {
 public:
  explicit Bench(const cases::Case& c) : c_(c), outline_(deck::bench_outline(c)) {}

  double height(const Vector3d& p) const {
    if (std::abs(p.y()) > c_.pile.width_m / 2) return 0;
    if (c_.pile.surface) return c_.pile.surface->height(p.x(), p.y());
    return cases::outline_height(outline_, p.x());
  }

 private:
  const cases::Case& c_;
  cases::BenchOutline outline_;
};

double deepest_in(const Bench& bench, const mesh::TriangleMesh& mesh, const Pose& X) {
  double deepest = 0;
  for (const Vector3d& v : mesh.vertices) {
    const Vector3d p = X * v;
    deepest = std::max(deepest, bench.height(p) - p.z());
  }
  return deepest;
}

/// A body that starts inside the rock throws it out.
void warn_of_the_start(const CaseParts& parts, std::vector<Finding>& warnings) {
  const cases::Case& c = parts.c;
  if (c.pile.clear_machine) return;  // the rock there is removed, and the run reports it
  const Bench bench(c);
  const machine::ShovelPose at_start = parts.shovel.pose(parts.motion.value(0));
  const double dipper = std::max(deepest_in(bench, parts.dipper, at_start.X_WB),
                                 deepest_in(bench, parts.door, at_start.X_WD));
  if (dipper > kDeep_m)
    warnings.push_back(cases::finding_at(
        c, "machine.motion",
        fmt::format(
            "at the start the dipper is {:.1f} m deep in the pile, which throws rock out; begin "
            "in front of the toe, or write pile.clear_machine: on",
            dipper)));
  if (const double truck = deepest_in(bench, parts.truck, Pose{}); truck > kDeep_m)
    warnings.push_back(cases::finding_at(
        c, "truck.position_m",
        fmt::format("the truck is {:.1f} m deep in the pile, so its bed counts rock that was never "
                    "dumped; move the truck or the pile",
                    truck)));
}

/// The corners of the dipper against the truck's solid parts, all along the motion.
void warn_of_the_way(const CaseParts& parts, std::vector<Finding>& warnings) {
  const mesh::Insides truck(parts.truck);
  double deepest = kDeep_m, at_s = 0;
  for (std::int64_t t = parts.motion.start_ns(); t <= parts.motion.end_ns(); t += kPlaceSample_ns) {
    const Pose X = parts.shovel.pose(parts.motion.value(t)).X_WB;
    for (const Vector3d& v : parts.dipper.vertices) {
      const Vector3d p = X * v;
      if (!truck.holds(p) || mesh::is_surface_near(parts.truck, p, deepest)) continue;
      deepest = mesh::signed_distance(parts.truck, p), at_s = seconds(t);
    }
  }
  if (deepest > kDeep_m)
    warnings.push_back(cases::finding_at(
        parts.c, "truck.position_m",
        fmt::format(
            "the dipper passes through the truck, {:.1f} m deep, at {:.1f} s; move the truck "
            "or lift the dipper higher",
            deepest, at_s)));
}

/// Checks that the truck stands on the ground. Its mesh may leave out the wheels.
void warn_of_the_ground(const CaseParts& parts, std::vector<Finding>& warnings) {
  const double low_m = mesh::bounding_box(parts.truck).min_m.z();
  if (low_m > -kSunk_m && low_m < kWheels_m) return;
  warnings.push_back(cases::finding_at(
      parts.c, "truck.position_m",
      fmt::format("the truck's lowest point is at z = {:.1f} m, and the ground at 0: does it {}?",
                  low_m, low_m < 0 ? "stand in the ground" : "float")));
}

/// Checks that the truck is under the door when it opens.
void warn_of_the_dump(const CaseParts& parts, std::vector<Finding>& warnings) {
  const Box bed = mesh::bounding_box(parts.truck);
  bool open = machine::door_is_open(parts.motion.value(0).door);
  for (std::int64_t t = parts.motion.start_ns(); t <= parts.motion.end_ns(); t += kPlaceSample_ns) {
    const machine::Drives drives = parts.motion.value(t);
    const bool was_open = open;
    open = machine::door_is_open(drives.door);
    if (!open || was_open) continue;
    const Vector3d p = parts.shovel.pose(drives).X_WB.p;
    if (p.x() > bed.min_m.x() && p.x() < bed.max_m.x() && p.y() > bed.min_m.y() &&
        p.y() < bed.max_m.y())
      continue;
    warnings.push_back(cases::finding_at(
        parts.c, "truck.position_m",
        fmt::format(
            "no truck is under the dipper when its door opens at {:.1f} s: the door is at x "
            "= {:.1f}, y = {:.1f} m, the truck between x = {:.1f} and {:.1f}, y = {:.1f} "
            "and {:.1f} m",
            seconds(t), p.x(), p.y(), bed.min_m.x(), bed.max_m.x(), bed.min_m.y(), bed.max_m.y())));
    return;
  }
}

/// Checks the place where contact with rock is on again during the return.
void warn_of_the_return(const CaseParts& parts, std::vector<Finding>& warnings) {
  if (parts.c.machine.contact_on_return) return;
  for (const machine::ReturnLeg& leg : machine::return_legs(parts.motion)) {
    const double turns_rad_s = std::abs(parts.motion.rate(leg.end_ns).swing);
    if (turns_rad_s <= kTurning_rad_s) continue;
    warnings.push_back(cases::finding_at(
        parts.c, "machine.motion",
        fmt::format(
            "the dipper swings into the rock: contact is on again from {:.1f} s, when the crowd "
            "is fully in, but the house still turns at {:.0f} deg/s; bring the crowd in "
            "later, or end the swing sooner",
            seconds(leg.end_ns), degrees(turns_rad_s))));
    return;
  }
}

/// The heel against the path of the teeth.
void warn_of_the_heel(const CaseParts& parts, std::vector<Finding>& warnings) {
  double most = kClosed_m, at_s = 0, above_m = 0;
  machine::TeethPath way;  // of this dig, outwards
  for (std::int64_t t = parts.motion.start_ns(); t <= parts.motion.end_ns(); t += kPlaceSample_ns) {
    const machine::Vector2d tip = parts.shovel.teeth(parts.motion.value(t));
    if (!way.empty() && tip.x() < way.back().x()) way.clear();
    way.push_back(tip);
    const machine::Vector2d heel = parts.shovel.heel(tip);
    const auto passed = std::find_if(way.begin(), way.end(),
                                     [&](const machine::Vector2d& p) { return p.x() >= heel.x(); });
    if (passed == way.end() || heel.y() > kNearGround_m) continue;
    const double closed = passed->y() - heel.y();
    if (closed <= most) continue;
    most = closed, at_s = seconds(t), above_m = heel.y();
  }
  if (most <= kClosed_m) return;
  warnings.push_back(cases::finding_at(
      parts.c, "machine.motion",
      fmt::format(
          "the dipper closes on the ground: at {:.1f} s its heel is {:.2f} m above it, "
          "{:.2f} m lower than the teeth passed there, and jams rock under the lip; let the "
          "teeth rise sooner (docs/motion.md)",
          at_s, above_m, most)));
}

}  // namespace

void warn_of_places(const CaseParts& parts, std::vector<Finding>& warnings) {
  warn_of_the_start(parts, warnings);
  warn_of_the_way(parts, warnings);
  warn_of_the_ground(parts, warnings);
  warn_of_the_dump(parts, warnings);
  warn_of_the_return(parts, warnings);
  warn_of_the_heel(parts, warnings);
}

}  // namespace dipper::check
