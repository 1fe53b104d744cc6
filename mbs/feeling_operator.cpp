#include "mbs/feeling_operator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dipper::mbs {
namespace {

constexpr double kWeighs_s = 0.5;
constexpr double kMostLift_m = 3;
constexpr double kMostDeeper_m = 0.6;
constexpr double kStands_rad_s = 1e-3;
constexpr double kShut_rad = 1e-3;
constexpr std::size_t kPathNumbers = 4;

}  // namespace

FeelingOperator::FeelingOperator(std::shared_ptr<const machine::Motion> motion,
                                 const machine::MachineData& machine, double rake, double full_kg)
    : motion_(motion),
      statics_(machine, rake),
      limits_{full_kg, machine.drives.crowd.stall},
      crowd_max_(machine.limits.crowd_max),
      path_(std::move(motion), machine.limits.crowd_min) {}

void FeelingOperator::reset(double t_s, const std::vector<double>& state) {
  const auto own = state.begin() + kPathNumbers;
  path_.reset(t_s, {state.begin(), own});
  updated_s_ = t_s;
  then_ = {state.at(kPathNumbers), state.at(kPathNumbers + 1), state.at(kPathNumbers + 2)};
  landed_ = state.at(kPathNumbers + 3) != 0;
  lift_slope_ = load_slope_ = 0;
}

FeelingOperator::Change FeelingOperator::at(double t_s) const {
  const double since = t_s - updated_s_;
  return {then_.lift + since * (then_.lift_rate + 0.5 * since * lift_slope_),
          then_.lift_rate + since * lift_slope_, then_.load_kg + since * load_slope_};
}

DigFeel FeelingOperator::feel(const Felt& felt, const PathState& path) {
  const machine::DriveState m = motion_->at(path.time);
  DigFeel f;
  f.at_face = std::abs(m.rate.swing) < kStands_rad_s && std::abs(m.position.door) < kShut_rad;
  f.pays_out = m.rate.hoist;
  f.overload = felt.motors.crowd.overload();
  f.hoist_overload = felt.motors.hoist.overload();
  f.behind_m = path.relief;
  f.load_kg = then_.load_kg;
  const double sent = m.position.crowd - path.relief;
  f.room_m = path.relief > -kMostDeeper_m ? crowd_max_ - sent : 0;
  load_slope_ = 0;
  try {
    const machine::Drives& at = felt.drives.position;
    const machine::HandlePlace place = statics_.at(at);
    // The hoist's coordinate is rope paid out: a pull is negative.
    const machine::Holding by{-felt.motors.hoist.force, felt.motors.crowd.force};
    const machine::DigLoad load = place.dig_load(by);
    f.carried = place.held(by).moment / place.empty().moment;
    f.resistance_N = load.resistance_N;
    f.handle_rise = place.handle_rise();
    if (f.overload < 1) load_slope_ = (load.load_kg - then_.load_kg) / kWeighs_s;
  } catch (const std::domain_error&) {
    f.carried = 0;  // more rope is out than a taut one would need
  }
  f.landed = landed_ = is_landed(landed_, f);
  return f;
}

void FeelingOperator::update(double t_s, const std::function<Felt()>& feels) {
  then_ = at(t_s);
  updated_s_ = t_s;
  DigWish wish;
  path_.ease(
      t_s,
      [&] {
        const Felt felt = feels();
        wish = dig_wish(feel(felt, path_.at(t_s)), limits_);
        return felt.motors.overload();
      },
      [&] {
        return PathWish{wish.rate, wish.crowd_back};
      });
  const double lift_rate = !wish.lift                 ? -then_.lift / PathFollower::kGiveOut_s
                           : then_.lift < kMostLift_m ? *wish.lift
                                                      : 0.0;
  lift_slope_ = (lift_rate - then_.lift_rate) / PathFollower::kReaction_s;
}

std::vector<double> FeelingOperator::state(double t_s) const {
  std::vector<double> all = path_.state(t_s);
  const Change now = at(t_s);
  all.insert(all.end(), {now.lift, now.lift_rate, now.load_kg, landed_ ? 1.0 : 0.0});
  return all;
}

machine::DriveState FeelingOperator::setpoint(double t_s) const {
  machine::DriveState s = path_.setpoint(t_s);
  const Change now = at(t_s);
  s.position.hoist -= now.lift;
  s.rate.hoist -= now.lift_rate;
  s.acceleration.hoist -= lift_slope_;
  return s;
}

std::vector<core::Channel> FeelingOperator::channels() const {
  std::vector<core::Channel> all = path_.channels();
  all.insert(all.end(), {{"hoist_lift", "m", "-"}, {"load_felt", "kg", "-"}});
  return all;
}

std::vector<double> FeelingOperator::values(double t_s, const DriveEfforts& motors) const {
  std::vector<double> all = path_.values(t_s, motors);
  const Change now = at(t_s);
  all.insert(all.end(), {now.lift, now.load_kg});
  return all;
}

}  // namespace dipper::mbs
