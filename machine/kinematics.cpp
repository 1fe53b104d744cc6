#include "machine/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/seconds.hpp"
#include "machine/sheave_path.hpp"

namespace dipper::machine {
namespace {

constexpr double kDegPerRad = 57.29577951308232;

/// Lifts x towards z: a rotation about -y.
Quaterniond elevate(double angle) {
  return Quaterniond(Eigen::AngleAxisd(-angle, Vector3d::UnitY()));
}

Vector2d in_plane(const Vector3d& p) { return {p.x(), p.z()}; }

/// Remembers the worst breach of one limit.
class Watch {
 public:
  Watch(std::string what, std::string unit, double factor, double low, double high)
      : what_(std::move(what)), unit_(std::move(unit)), factor_(factor), low_(low), high_(high) {}

  void see(double value, double t_s) {
    const double excess = std::max(low_ - value, value - high_);
    if (excess <= worst_) return;
    if (worst_ <= kRoundOff) first_s_ = t_s;
    worst_ = excess;
    value_ = value;
    t_s_ = t_s;
  }

  void report(std::vector<std::string>& messages) const {
    if (worst_ <= kRoundOff) return;
    const bool below = value_ < low_;
    messages.push_back(
        fmt::format("{} is {:.3f} {} at {:.3f} s, {} the limit of {:.3f} {} (from {:.3f} s)", what_,
                    value_ * factor_, unit_, t_s_, below ? "below" : "above",
                    (below ? low_ : high_) * factor_, unit_, first_s_));
  }

 private:
  static constexpr double kRoundOff = 1e-9;
  std::string what_, unit_;
  double factor_, low_, high_;
  double worst_ = kRoundOff, value_ = 0, t_s_ = 0, first_s_ = 0;
};

}  // namespace

ShovelKinematics::ShovelKinematics(const MachineData& machine, const Pose& X_W0, double rake)
    : machine_(machine), X_W0_(X_W0) {
  X_EB_.R = elevate(rake);
  X_EB_.p = -(X_EB_.R * machine.dipper.handle_end);
}

double ShovelKinematics::rope_path(double saddle, double crowd) const {
  const Pose X_HE =
      Pose{Quaterniond::Identity(), machine_.saddle.position} *
      Pose{elevate(saddle), Vector3d::Zero()} *
      Pose{Quaterniond::Identity(), Vector3d(machine_.handle.reach_at_zero_crowd + crowd, 0, 0)};
  const Vector3d p_HL = X_HE * (X_EB_ * machine_.dipper.bail);
  return sheave_path(in_plane(machine_.rope.drum - machine_.boom.point),
                     in_plane(p_HL - machine_.boom.point), machine_.boom.sheave_radius)
      .length;
}

double ShovelKinematics::saddle_angle(double hoist, double crowd) const {
  const double rope = machine_.rope.length_at_zero_hoist + hoist;
  // Raising the handle shortens the path, so there is at most one root; bisection finds it.
  double low = machine_.limits.saddle_min;
  double high = machine_.limits.saddle_max;
  const double longest = rope_path(low, crowd);
  const double shortest = rope_path(high, crowd);
  if (!(rope <= longest && rope >= shortest)) {
    throw std::domain_error(fmt::format(
        "no saddle angle puts the bail at hoist {:.3f} m, crowd {:.3f} m: at this crowd hoist "
        "reaches from {:.3f} to {:.3f} m",
        hoist, crowd, shortest - machine_.rope.length_at_zero_hoist,
        longest - machine_.rope.length_at_zero_hoist));
  }
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    (rope_path(middle, crowd) > rope ? low : high) = middle;
  }
}

Vector2d ShovelKinematics::end_to_teeth() const {
  const MachineData::Dipper& d = machine_.dipper;
  return in_plane(X_EB_ * Vector3d(d.inside.x() + d.tooth_reach, 0, -d.inside.z() / 2));
}

double ShovelKinematics::teeth_reach(double crowd) const {
  return (Vector2d(machine_.handle.reach_at_zero_crowd + crowd, 0) + end_to_teeth()).norm();
}

Vector2d ShovelKinematics::teeth(const Drives& drives) const {
  const double saddle = saddle_angle(drives.hoist, drives.crowd);
  const Vector2d out(machine_.handle.reach_at_zero_crowd + drives.crowd, 0);
  return in_plane(machine_.saddle.position) + Eigen::Rotation2Dd(saddle) * (out + end_to_teeth());
}

ShovelKinematics::Arm ShovelKinematics::arm_to(const Vector2d& tip) const {
  const Vector2d arm = tip - in_plane(machine_.saddle.position), tool = end_to_teeth();
  const double along = arm.squaredNorm() - tool.y() * tool.y();
  if (!(along > 0)) throw std::domain_error("it is at the saddle block");
  const double handle = std::sqrt(along) - tool.x();
  return {handle - machine_.handle.reach_at_zero_crowd,
          std::atan2(arm.y(), arm.x()) - std::atan2(tool.y(), handle + tool.x())};
}

Drives ShovelKinematics::teeth_at(const Vector2d& tip) const {
  const Arm arm = arm_to(tip);
  Drives drives;
  drives.crowd = arm.crowd;
  drives.hoist = rope_path(arm.saddle, arm.crowd) - machine_.rope.length_at_zero_hoist;
  return drives;
}

Vector2d ShovelKinematics::heel(const Vector2d& tip) const {
  const MachineData::Dipper& d = machine_.dipper;
  const Vector3d back = X_EB_.R * Vector3d(-d.inside.x() - d.tooth_reach, 0, 0);
  return tip + Eigen::Rotation2Dd(arm_to(tip).saddle) * in_plane(back);
}

ShovelPose ShovelKinematics::pose(const Drives& drives) const {
  return pose(drives, saddle_angle(drives.hoist, drives.crowd));
}

ShovelPose ShovelKinematics::pose(const Drives& drives, double saddle) const {
  const Quaterniond swing(Eigen::AngleAxisd(drives.swing, Vector3d::UnitZ()));
  const Pose X_WB = X_W0_ * Pose{swing, Vector3d::Zero()} *
                    Pose{elevate(saddle), machine_.saddle.position} *
                    Pose{Quaterniond::Identity(),
                         Vector3d(machine_.handle.reach_at_zero_crowd + drives.crowd, 0, 0)} *
                    X_EB_;
  const Pose X_BD{elevate(-drives.door), machine_.door.hinge};
  return {saddle, X_WB, X_WB * X_BD};
}

std::vector<std::string> ShovelKinematics::check(const Motion& motion) const {
  const MachineData::Limits& l = machine_.limits;
  constexpr double far = std::numeric_limits<double>::infinity();
  Watch hoist("hoist", "m", 1, l.hoist_min, l.hoist_max);
  Watch crowd("crowd", "m", 1, l.crowd_min, l.crowd_max);
  Watch door("door", "deg", kDegPerRad, l.door_min, l.door_max);
  Watch hoist_speed("hoist speed", "m/s", 1, -l.hoist_speed, l.hoist_speed);
  Watch crowd_speed("crowd speed", "m/s", 1, -l.crowd_speed, l.crowd_speed);
  Watch swing_speed("swing speed", "deg/s", kDegPerRad, -l.swing_speed, l.swing_speed);
  Watch ground("the dipper's lowest point", "m", 1, 0, far);
  std::vector<std::string> messages;
  bool reached = true;

  const Vector3d half = 0.5 * machine_.dipper.inside;
  constexpr std::int64_t period_ns = 20'000'000;
  const std::int64_t n = (motion.end_ns() - motion.start_ns() + period_ns - 1) / period_ns;
  for (std::int64_t i = 0; i <= n; ++i) {
    const std::int64_t t_ns = std::min(motion.start_ns() + i * period_ns, motion.end_ns());
    const double t_s = seconds(t_ns);
    const DriveState s = motion.at(t_s);
    hoist.see(s.position.hoist, t_s);
    crowd.see(s.position.crowd, t_s);
    door.see(s.position.door, t_s);
    hoist_speed.see(s.rate.hoist, t_s);
    crowd_speed.see(s.rate.crowd, t_s);
    swing_speed.see(s.rate.swing, t_s);
    try {
      const ShovelPose X = pose(s.position);
      const double tip = machine_.dipper.inside.x() + machine_.dipper.tooth_reach;
      for (const double side : {-half.y(), half.y()}) {
        for (const Vector3d& p_B : {Vector3d(0, side, -half.z()), Vector3d(tip, side, -half.z())}) {
          ground.see((X.X_WB * p_B).z() - X_W0_.p.z(), t_s);
        }
        ground.see((X.X_WD * Vector3d(0, side, -machine_.dipper.inside.z())).z() - X_W0_.p.z(),
                   t_s);
      }
    } catch (const std::domain_error& e) {
      if (reached) messages.push_back(fmt::format("at {:.3f} s {}", t_s, e.what()));
      reached = false;
    }
  }
  for (const Watch* w :
       {&hoist, &crowd, &door, &hoist_speed, &crowd_speed, &swing_speed, &ground}) {
    w->report(messages);
  }
  return messages;
}

}  // namespace dipper::machine
