#include "mbs/path_follower.hpp"

#include <algorithm>

namespace dipper::mbs {
namespace {

constexpr double kFull = 1.5;           // overload of the slowest rate
constexpr double kStalledCrowd = 0.25;  // rate along the motion with a stalled crowd
constexpr double kComesAlong = 1.4;     // overload from which the crowd retracts
constexpr double kAlong_m_s = 0.5;      // at kFull - kComesAlong more; about the crowd's speed
constexpr double kNearlyStopped = 0.2;
constexpr double kLetBack_m_s = 0.1;  // a tenth of the crowd's speed: a short stall changes little

double eased(double overload) { return std::clamp((overload - 1) / (kFull - 1), 0.0, 1.0); }

machine::Drives sum(double a, const machine::Drives& x, double b, const machine::Drives& y) {
  return {a * x.hoist + b * y.hoist, a * x.crowd + b * y.crowd, a * x.swing + b * y.swing,
          a * x.door + b * y.door};
}

}  // namespace

PathFollower::PathFollower(std::shared_ptr<const machine::Motion> motion, double crowd_min)
    : motion_(std::move(motion)), crowd_min_(crowd_min) {}

void PathFollower::go_on(double t_s, const PathState& from) {
  updated_s_ = t_s;
  then_ = from;
  rate_slope_ = relief_slope_ = 0;
}

void PathFollower::reset(double t_s, const std::vector<double>& state) {
  go_on(t_s, {state.at(0), state.at(1), state.at(2), state.at(3)});
}

void PathFollower::ease(double t_s, const std::function<Overload()>& overload,
                        const std::function<PathWish()>& wished) {
  go_on(t_s, at(t_s));
  const Overload r = overload();
  const PathWish wish = wished();
  const double crowd = eased(r.crowd);
  const double wanted = std::min({wish.rate, 1 - eased(r.others), 1 - (1 - kStalledCrowd) * crowd});
  rate_slope_ = (wanted - then_.rate) / kReaction_s;
  const double along = std::clamp((r.crowd - kComesAlong) / (kFull - kComesAlong), 0.0, 1.0);
  const double back = std::max(0.0, 1 - then_.rate / kNearlyStopped);
  const double let_back = std::max(kAlong_m_s * along, kLetBack_m_s * back);
  const bool at_stop = motion_->at(then_.time).position.crowd - then_.relief <= crowd_min_;
  double relief_rate = at_stop ? 0.0 : let_back;
  if (let_back == 0 && !wish.crowd_back)
    relief_rate = -(1 - crowd) * then_.relief / kGiveOut_s;
  else if (wish.crowd_back && *wish.crowd_back > let_back)
    relief_rate = at_stop ? 0.0 : *wish.crowd_back;
  else if (wish.crowd_back && let_back == 0)
    relief_rate = *wish.crowd_back;
  relief_slope_ = (relief_rate - then_.relief_rate) / kReaction_s;
}

PathState PathFollower::at(double t_s) const {
  const double since = t_s - updated_s_;
  return {then_.time + since * (then_.rate + 0.5 * since * rate_slope_),
          then_.rate + since * rate_slope_,
          then_.relief + since * (then_.relief_rate + 0.5 * since * relief_slope_),
          then_.relief_rate + since * relief_slope_};
}

std::vector<double> PathFollower::state(double t_s) const {
  const PathState now = at(t_s);
  return {now.time, now.rate, now.relief, now.relief_rate};
}

std::vector<core::Channel> PathFollower::channels() const {
  return {{"path_time", "s", "-"}, {"path_rate", "1", "-"}, {"crowd_relief", "m", "-"}};
}

std::vector<double> PathFollower::values(double t_s, const DriveEfforts&) const {
  const PathState now = at(t_s);
  return {now.time, now.rate, now.relief};
}

machine::DriveState PathFollower::setpoint(double t_s) const {
  const PathState now = at(t_s);
  const machine::DriveState m = motion_->at(now.time);
  machine::DriveState s{m.position, sum(now.rate, m.rate, 0, m.rate),
                        sum(now.rate * now.rate, m.acceleration, rate_slope_, m.rate)};
  s.position.crowd -= now.relief;
  s.rate.crowd -= now.relief_rate;
  s.acceleration.crowd -= relief_slope_;
  return s;
}

}  // namespace dipper::mbs
