#include "mbs/program_operator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/seconds.hpp"

namespace dipper::mbs {
namespace {

machine::Drives drives(const std::array<double, ProgramOperator::kDrives>& row) {
  return {row[0], row[1], row[2], row[3]};
}

}  // namespace

ProgramOperator::ProgramOperator(const machine::Drives& at)
    : position_{at.hoist, at.crowd, at.swing, at.door}, to_(position_) {}

void ProgramOperator::take(double t_s, const core::Order& order) {
  if (order.to.size() != 2 * kDrives)
    throw std::invalid_argument(
        fmt::format("an order of {} numbers; there must be {}: positions "
                    "and rates of hoist, crowd, swing and door",
                    order.to.size(), 2 * kDrives));
  const double by_s = seconds(order.by_ns);
  if (by_s <= t_s)
    throw std::invalid_argument(fmt::format("an order for {} s comes at {} s", by_s, t_s));
  const Point now = point(t_s);
  from_s_ = t_s;
  by_s_ = by_s;
  position_ = now.position;
  rate_ = now.rate;
  std::copy_n(order.to.begin(), kDrives, to_.begin());
  std::copy_n(order.to.begin() + kDrives, kDrives, to_rate_.begin());
}

ProgramOperator::Point ProgramOperator::point(double t_s) const {
  Point s;
  const double h = by_s_ - from_s_, left = t_s - by_s_;
  for (std::size_t d = 0; d < kDrives; ++d) {
    if (left >= 0) {
      s.position[d] = to_[d] + left * to_rate_[d];
      s.rate[d] = to_rate_[d];
      continue;
    }
    // Newton's form about the end, which the last order's positions and rates meet to the bit.
    const double mean = (to_[d] - position_[d]) / h;
    const double c = (to_rate_[d] - mean) / h, e = (rate_[d] + to_rate_[d] - 2 * mean) / (h * h);
    const double since = t_s - from_s_;
    s.position[d] = to_[d] + left * (to_rate_[d] + left * (c + since * e));
    s.rate[d] = to_rate_[d] + 2 * left * c + left * (left + 2 * since) * e;
    s.acceleration[d] = 2 * c + (4 * left + 2 * since) * e;
  }
  return s;
}

machine::DriveState ProgramOperator::setpoint(double t_s) const {
  const Point s = point(t_s);
  return {drives(s.position), drives(s.rate), drives(s.acceleration)};
}

std::vector<double> ProgramOperator::state(double) const {
  std::vector<double> all = {from_s_, by_s_};
  for (const Row* row : {&position_, &rate_, &to_, &to_rate_})
    all.insert(all.end(), row->begin(), row->end());
  return all;
}

void ProgramOperator::reset(double, const std::vector<double>& state) {
  from_s_ = state.at(0);
  by_s_ = state.at(1);
  auto next = state.begin() + 2;
  for (Row* row : {&position_, &rate_, &to_, &to_rate_}) {
    std::copy_n(next, kDrives, row->begin());
    next += kDrives;
  }
}

std::vector<core::Channel> ProgramOperator::channels() const {
  return {{"path_time", "s", "-"},     {"path_rate", "1", "-"},      {"crowd_relief", "m", "-"},
          {"sent_hoist", "m", "-"},    {"sent_crowd", "m", "-"},     {"sent_swing", "rad", "W"},
          {"sent_door", "rad", "B"},   {"hoist_overload", "1", "-"}, {"crowd_overload", "1", "-"},
          {"swing_overload", "1", "-"}};
}

std::vector<double> ProgramOperator::values(double t_s, const DriveEfforts& motors) const {
  const Row at = point(t_s).position;
  return {t_s,
          1,
          0,
          at[0],
          at[1],
          at[2],
          at[3],
          motors.hoist.overload(),
          motors.crowd.overload(),
          motors.swing.overload()};
}

}  // namespace dipper::mbs
