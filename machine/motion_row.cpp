#include "machine/motion_row.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "common/angles.hpp"

namespace dipper::machine {
namespace {

/// To the microsecond, with at least two digits after the point.
std::string time_text(double t_s) {
  std::string text = fmt::format("{:.6f}", t_s);
  while (text.back() == '0' && text[text.size() - 3] != '.') text.pop_back();
  return text;
}

double rounded(double value) { return std::round(value * 1e4) / 1e4 + 0.0; }

}  // namespace

std::string motion_row(double t_s, const Eigen::Vector2d& tip, double swing_rad, double door_rad,
                       const ShovelKinematics& shovel) {
  try {
    const Drives d = shovel.teeth_at(tip);
    return fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f}\n", time_text(t_s), rounded(d.hoist),
                       rounded(d.crowd), rounded(degrees(swing_rad)), rounded(degrees(door_rad)));
  } catch (const std::domain_error& e) {
    throw std::domain_error(
        fmt::format("at {:.2f} s the teeth cannot be at x = {:.2f} m, z = {:.2f} m: {}", t_s,
                    tip.x(), tip.y(), e.what()));
  }
}

}  // namespace dipper::machine
