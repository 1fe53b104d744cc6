#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/angles.hpp"
#include "common/seconds.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/check/warning_parts.hpp"
#include "coupler/deck/contact_table.hpp"
#include "machine/door.hpp"

namespace dipper::check {
namespace {

constexpr double kOtherUnit = 2.5;        ///< a mesh so many times too large or small is not in m
constexpr double kMostFeet = 5;           ///< a mesh in feet is some 3.3 times too large
constexpr double kLargestRock = 1.0 / 3;  ///< of the dipper's mouth: larger rocks bridge it
constexpr double kShift_m = 0.5;
constexpr double kSlightest = 0.05;  ///< radius of gyration by a body's size
constexpr double kHole_s = 3;        ///< between two rows of a motion in which drives go far
constexpr double kLoosest = 0.4, kDensest = 0.8;  ///< rock in a pile's volume; blasted, some 0.6
constexpr double kWater_kg_m3 = 1000;
constexpr double kReadings = 10;          ///< that dipper gap needs of each pass
constexpr std::int64_t kSeeds = 800'000;  ///< LIGGGHTS's streams repeat (coupler/deck/deck.cpp)
constexpr double kBlind_m = 1;            ///< of a scan
constexpr double kFewSteps = 20;          ///< between two checkpoints
constexpr double kDump_s = 1;             ///< a load needs longer to leave
constexpr double kLongestPass_s = 300;    ///< 20 to 60 s are usual
constexpr double kLargestTruck_t = 450;   ///< BelAZ 75710
constexpr double kLongestRest_s = 100;    ///< poured rock comes to rest in some 5 s
constexpr double kLongest = 2;  ///< times the motion's duration, which limited drives may take
constexpr std::int64_t kDoorEvery_ns = 50'000'000;
constexpr double kWindow_s = 0.01;  ///< the empty dipper on its ropes swings with some 0.2 s

void warn_of_mesh(const CaseParts& parts, std::vector<Finding>& warnings) {
  const Vector3d wanted = parts.machine.dipper.inside;  // without plates and teeth
  const Box box = mesh::bounding_box(parts.dipper);
  const Vector3d sides = box.sides_m();
  const double scale = sides.maxCoeff() / wanted.maxCoeff();
  const auto say = [&](const std::string& what) {
    warnings.push_back(cases::finding_at(parts.c, "bodies.dipper", what));
  };
  if (scale > kOtherUnit || scale < 1 / kOtherUnit) {
    const bool feet = scale > kOtherUnit && scale < kMostFeet;
    const double factor = scale > 100 ? 0.001 : feet ? 0.3048 : 1 / scale;
    return say(fmt::format(
        "the mesh is {:.4g} units long, but the machine's dipper is {:g} m: is it in {}? scale it "
        "by {:.3g}",
        sides.maxCoeff(), wanted.maxCoeff(),
        scale > 100 ? "mm"
        : feet      ? "ft"
                    : "another unit",
        factor));
  }
  const auto misfit = [&](const Vector3d& s) { return (s - wanted).cwiseAbs().sum(); };
  const Vector3d y_up(sides.x(), sides.z(), sides.y());
  if (misfit(y_up) + 1 < misfit(sides))
    return say(
        fmt::format("the mesh is {:.1f} x {:.1f} x {:.1f} m along x, y and z, but the machine's "
                    "dipper is {:g} x {:g} x {:g} m: is its y up? rotate it so that z is up",
                    sides.x(), sides.y(), sides.z(), wanted.x(), wanted.y(), wanted.z()));
  const Vector3d middle = 0.5 * (box.min_m + box.max_m);
  if (std::abs(middle.y()) > kShift_m || std::abs(middle.z()) > kShift_m ||
      std::abs(box.min_m.x()) > kShift_m)
    say(
        fmt::format("the mesh begins at x = {:.2f} m with its middle at y = {:.2f}, z = {:.2f}; "
                    "its origin must be in the middle of the rear opening (docs/frames.md)",
                    box.min_m.x(), middle.y(), middle.z()));
}

void warn_of_angles_of_motion(const CaseParts& parts, std::vector<Finding>& warnings) {
  double swing = 0, door = 0;
  for (std::int64_t t = parts.motion.start_ns(); t <= parts.motion.end_ns(); t += 100'000'000) {
    const machine::Drives d = parts.motion.value(t);
    swing = std::max(swing, std::abs(d.swing));
    door = std::max(door, std::abs(d.door));
  }
  const auto in_rad = [](double most) { return most > radians(0.3) && most < radians(3.2); };
  for (const auto& [name, most] : {std::pair{"swing_deg", swing}, std::pair{"door_deg", door}})
    if (in_rad(most))
      warnings.push_back(
          {parts.c.machine.motion, 0, name,
           fmt::format("never exceeds {:.2f} degrees: is it in rad?", degrees(most))});
  if (swing > 2 * M_PI)
    warnings.push_back(
        {parts.c.machine.motion, 0, "swing_deg",
         fmt::format("reaches {:.0f} degrees, more than a full turn: is it in gon, or counted on "
                     "over many turns? 100 gon are 90 degrees",
                     degrees(swing))});
}

/// Compares a body's radius of gyration with its size.
void warn_of_masses(const CaseParts& parts, std::vector<Finding>& warnings) {
  struct Part {
    std::string key;
    double mass_kg, inertia_kg_m2, size_m;
  };
  const machine::MachineData& m = parts.machine;
  const double dipper_m = m.dipper.inside.maxCoeff();
  for (const Part& p : {Part{"house.swing_inertia", m.house.mass, m.house.swing_inertia,
                             std::abs(m.boom.point.x())},
                        Part{"handle.mass", m.handle.mass, m.handle.inertia.maxCoeff(),
                             m.handle.reach_at_zero_crowd},
                        Part{"dipper.mass", m.dipper.mass, m.dipper.inertia.maxCoeff(), dipper_m},
                        Part{"door.mass", m.door.mass, m.door.inertia.maxCoeff(), dipper_m}}) {
    const double gyration_m = std::sqrt(p.inertia_kg_m2 / p.mass_kg);
    if (gyration_m > p.size_m || gyration_m < kSlightest * p.size_m)
      warnings.push_back(
          {parts.c.machine.model, 0, p.key,
           fmt::format("{:g} kg and an inertia of {:g} kg m2 give a radius of gyration of {:.2g} m "
                       "for a body of about {:g} m: is one of them in another unit?",
                       p.mass_kg, p.inertia_kg_m2, gyration_m, p.size_m)});
  }
}

void warn_of_rock(const CaseParts& parts, std::vector<Finding>& warnings) {
  const cases::Case& c = parts.c;
  double largest = 0, true_size = 0;
  for (const deck::RockClass& rock : deck::rock_classes(c))
    largest = std::max(largest, 2 * rock.radius_m);
  for (const cases::SizeClass& k : c.rock.classes) true_size = std::max(true_size, k.size_m);
  const double mouth = std::min(parts.machine.dipper.inside.y(), parts.machine.dipper.inside.z());
  if (largest > kLargestRock * mouth) {
    const bool too_large = true_size > kLargestRock * mouth;
    warnings.push_back(cases::finding_at(
        c, too_large ? "rock.classes" : "rock.coarse_graining",
        fmt::format("rocks of {:.2f} m are larger than a third of the dipper's mouth ({:g} m) and "
                    "bridge it; write {}: {:.2g} or less",
                    largest, mouth, too_large ? "size_m" : "rock.coarse_graining_limit_m",
                    kLargestRock * mouth)));
  }
  if (const double solid = c.rock.bulk_density_kg_m3 / c.rock.density_kg_m3; solid > kDensest)
    warnings.push_back(cases::finding_at(
        c, "rock.bulk_density_kg_m3",
        fmt::format("{:g} kg/m3 is {:.0f} % of solid rock's, {:g} kg/m3, and blasted rock has some "
                    "60: is it the density of solid rock?",
                    c.rock.bulk_density_kg_m3, 100 * solid, c.rock.density_kg_m3)));
  if (c.rock.density_kg_m3 < kWater_kg_m3)
    warnings.push_back(
        cases::finding_at(c, "rock.density_kg_m3",
                          fmt::format("{:g} kg/m3 is lighter than water: in lb/ft3, perhaps?",
                                      c.rock.density_kg_m3)));
  else if (c.rock.bulk_density_kg_m3 < kLoosest * c.rock.density_kg_m3)
    warnings.push_back(cases::finding_at(
        c, "rock.bulk_density_kg_m3",
        fmt::format("{:g} kg/m3 leaves {:.0f} % voids in rock of {:g} kg/m3: in lb/ft3, perhaps? "
                    "The load that the dipper can hold follows from it",
                    c.rock.bulk_density_kg_m3,
                    100 * (1 - c.rock.bulk_density_kg_m3 / c.rock.density_kg_m3),
                    c.rock.density_kg_m3)));
  const double wide = mesh::bounding_box(parts.dipper).sides_m().y();
  if (c.pile.width_m < wide)
    warnings.push_back(cases::finding_at(
        c, "pile.width_m",
        fmt::format("the pile, {:g} m wide, is narrower than the dipper, {:.1f} m", c.pile.width_m,
                    wide)));
}

void warn_of_times(const CaseParts& parts, std::vector<Finding>& warnings) {
  const double window_s = parts.c.coupling.sync_steps * parts.c.dem.timestep_s;
  if (window_s > kWindow_s)
    warnings.push_back(cases::finding_at(
        parts.c, "coupling.sync_steps",
        fmt::format(
            "a sync step of {:.3g} s is too long for the vibration of the dipper on its ropes, "
            "which takes at most {} steps; against rock take 1 to 1.5 ms (docs/coupling.md)",
            window_s, std::max(1.0, std::floor(kWindow_s / parts.c.dem.timestep_s)))));
  const double rate_Hz = parts.c.observation.rate_Hz, motion_s = seconds(parts.motion.end_ns());
  if (parts.c.origins.count("observation.rate_Hz") && rate_Hz * motion_s < kReadings)
    warnings.push_back(cases::finding_at(
        parts.c, "observation.rate_Hz",
        fmt::format("{:g} Hz is a reading every {:.3g} s in a motion of {:.4g} s, and dipper gap "
                    "needs {:g} per pass",
                    rate_Hz, 1 / rate_Hz, motion_s, kReadings)));
  for (std::int64_t t = parts.motion.start_ns(); t < parts.motion.end_ns();) {
    const std::int64_t next = std::min(parts.motion.next_row_ns(t), parts.motion.end_ns());
    const machine::Drives a = parts.motion.value(t), b = parts.motion.value(next);
    if (seconds(next - t) > kHole_s &&
        (std::abs(b.hoist - a.hoist) > 1 || std::abs(b.crowd - a.crowd) > 0.5)) {
      warnings.push_back(
          {parts.c.machine.motion, 0, "time_s",
           fmt::format("no row between {:.2f} and {:.2f} s, although the drives move far",
                       seconds(t), seconds(next))});
      return;
    }
    t = next;
  }
}

/// A run that ends before its first load is in the truck, and so has no pass.
void warn_of_end(const CaseParts& parts, std::vector<Finding>& warnings) {
  const machine::Motion& motion = parts.motion;
  std::int64_t t = motion.start_ns();
  const auto is_open = [&] { return machine::door_is_open(motion.value(t).door); };
  while (t < motion.end_ns() && is_open()) t += kDoorEvery_ns;  // left open after the last dump
  while (t < motion.end_ns() && !is_open()) t += kDoorEvery_ns;
  if (!is_open())
    warnings.push_back({parts.c.machine.motion, 0, "door_deg",
                        "never opens after the start: the run has no pass and loads no truck"});
  else if (seconds(t) > kLongestPass_s)
    warnings.push_back({parts.c.machine.motion, 0, "time_s",
                        fmt::format("the first pass ends at {:.0f} s, where 20 to 60 s are usual: "
                                    "are the times in seconds?",
                                    seconds(t))});
  else if (parts.c.end_s > 0 && parts.c.end_s <= seconds(t) + kDump_s)
    warnings.push_back(cases::finding_at(
        parts.c, "end_s",
        fmt::format("the run ends at {:g} s, and the door opens over the truck at {:.1f} s: its "
                    "first pass is not complete",
                    parts.c.end_s, seconds(t))));
  if (const double end_s = seconds(motion.end_ns());
      parts.c.machine.operated_by == cases::OperatorKind::motion &&
      parts.c.end_s > kLongest * end_s)
    warnings.push_back(cases::finding_at(
        parts.c, "end_s",
        fmt::format("the run ends at {:g} s, and the motion at {:.1f} s: the machine stands still "
                    "after it",
                    parts.c.end_s, end_s)));
}

/// What is set here overrides what is set in a place with a lower number.
int layer_of(const cases::Case& c, const std::string& key) {
  const auto set = c.origins.find(key);
  if (set == c.origins.end()) return 0;
  if (set->second.file == "--set") return 3;
  return set->second.file == c.folder / "case.yaml" ? 2 : 1;  // 1: an included case
}

/// A mine's motion of several passes that an operator who plans does not follow. Not where he takes
/// the place of a case's own motion.
void warn_of_unused_motion(const CaseParts& parts, std::vector<Finding>& warnings) {
  if (!parts.planned() ||
      layer_of(parts.c, "machine.motion") < layer_of(parts.c, "machine.operator"))
    return;
  const machine::Motion motion = machine::Motion::load(parts.c.machine.motion);
  int dumps = 0;
  bool was_open = true;
  for (std::int64_t t = motion.start_ns(); t < motion.end_ns(); t += kDoorEvery_ns) {
    const bool open = machine::door_is_open(motion.value(t).door);
    dumps += open && !was_open;
    was_open = open;
  }
  if (dumps > 1)
    warnings.push_back(cases::finding_at(
        parts.c, "machine.operator",
        fmt::format("plan: of machine.motion, which has {} dumps, only the start is used, since "
                    "the operator plans each pass; write machine.operator: motion to follow it",
                    dumps)));
}

/// Settings far from what they are for.
void warn_of_settings(const CaseParts& parts, std::vector<Finding>& warnings) {
  const cases::Case& c = parts.c;
  const auto say = [&](const std::string& key, const std::string& what) {
    warnings.push_back(cases::finding_at(c, key, what));
  };
  const double full_t = 1e-3 * c.rock.bulk_density_kg_m3 * parts.machine.dipper.struck_volume;
  if (c.truck.rated_t > 0 && c.truck.rated_t < full_t / 2)
    say("truck.rated_t",
        fmt::format("{:g} t is less than half of a full dipper, {:.0f} t: is it in kt?",
                    c.truck.rated_t, full_t));
  if (c.truck.rated_t > kLargestTruck_t)
    say("truck.rated_t",
        fmt::format("{:g} t is more than the largest truck carries, {:g} t: is it in t?",
                    c.truck.rated_t, kLargestTruck_t));
  if (c.pile.settle_s > kLongestRest_s)
    say("pile.settle_s",
        fmt::format("{:g} s, and poured rock comes to rest in some 5 s: is it in s?",
                    c.pile.settle_s));
  if (const double run_s = c.end_s > 0 ? c.end_s : cases::motion_end_s(c);
      c.output.dump_every_s > run_s)
    say("output.dump_every_s",
        fmt::format("{:g} s is longer than the run, {:g} s: the report has one frame; is it in s?",
                    c.output.dump_every_s, run_s));
  if (c.op.scan_error_m > kBlind_m)
    say("operator.scan_error_m",
        fmt::format("with an error of {:g} m the operator cannot tell where the face is; scanners "
                    "have some 0.05 m",
                    c.op.scan_error_m));
  if (c.collapse.height_m > 0 && (c.machine.operated_by == cases::OperatorKind::plan ||
                                  c.machine.drives == machine::DriveMode::limited))
    say("collapse.at_s",
        fmt::format(
            "where the dipper is at {:g} s depends on how the dig goes, and rock that comes "
            "down inside it is thrown out: choose a time at which it is over the truck",
            c.collapse.at_s));
  if (c.seed >= kSeeds)
    say("seed", fmt::format("{} gives the same pile as seed {}", c.seed, c.seed % kSeeds));
  const double window_s = c.coupling.sync_steps * c.dem.timestep_s;
  if (c.output.checkpoint_every_s > 0 && c.output.checkpoint_every_s < kFewSteps * window_s)
    say("output.checkpoint_every_s",
        fmt::format("{:g} s are {:.2g} sync steps, and a checkpoint costs as much as some hundred; "
                    "write 5",
                    c.output.checkpoint_every_s, c.output.checkpoint_every_s / window_s));
}

/// Keys that the case sets and nothing reads.
void warn_of_unused_keys(const cases::Case& c, std::vector<Finding>& warnings) {
  const auto say = [&](const std::string& section, const std::string& why,
                       const std::string& turned_off_by = "") {
    for (const auto& [key, origin] : c.origins)
      if (key.rfind(section, 0) == 0 && layer_of(c, key) >= layer_of(c, turned_off_by))
        warnings.push_back(cases::finding_at(c, key, "has no effect with " + why));
  };
  // Who turns something off does not have to remove its keys from an included case, or for --set.
  if (c.machine.operated_by == cases::OperatorKind::motion)
    say("operator.", "machine.operator: motion; write machine.operator: plan", "machine.operator");
  if (c.collapse.height_m == 0) say("collapse.at_s", "collapse.height_m: 0", "collapse.height_m");
  if (c.crust.tensile_strength_Pa == 0)
    say("crust.", "crust.tensile_strength_Pa: 0", "crust.tensile_strength_Pa");
  const bool grown = std::any_of(
      c.rock.classes.begin(), c.rock.classes.end(),
      [&](const cases::SizeClass& k) { return deck::grained_size_m(c.rock, k.size_m) > k.size_m; });
  if (c.rock.coarse_graining > 1 && !grown)
    say("rock.coarse_graining",
        fmt::format("rock.coarse_graining_limit_m: {:g}, as every rock is as large",
                    c.rock.coarse_graining_limit_m));
  if (c.collapse.height_m > 0 && c.end_s > 0 && c.collapse.at_s >= c.end_s)
    say("collapse.", fmt::format("end_s: {:g}; the slab comes down later", c.end_s));
}

}  // namespace

void warn_of_numbers(const CaseParts& parts, std::vector<Finding>& warnings) {
  warn_of_mesh(parts, warnings);
  warn_of_angles_of_motion(parts, warnings);
  warn_of_masses(parts, warnings);
  warn_of_rock(parts, warnings);
  warn_of_times(parts, warnings);
  warn_of_end(parts, warnings);
  warn_of_unused_motion(parts, warnings);
  warn_of_settings(parts, warnings);
  warn_of_unused_keys(parts.c, warnings);
}

}  // namespace dipper::check
