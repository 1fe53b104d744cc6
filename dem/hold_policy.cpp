#include "dem/hold_policy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dipper::dem {
namespace {

constexpr std::uint8_t kWakes = rest_flag::near | rest_flag::soon | rest_flag::disturbed;

}  // namespace

WallZone::WallZone(const BodyBox& box, const Pose& X_WB, const Twist& V_WB_W, double ahead_s,
                   double margin_m)
    : box_{box.min_m.array() - margin_m, box.max_m.array() + margin_m} {
  const double size = (box.max_m - box.min_m).norm() / 2;
  const double way = (V_WB_W.v.norm() + V_WB_W.w.norm() * size) * ahead_s;
  const int samples = ahead_s > 0 ? std::max(1, static_cast<int>(std::ceil(way / margin_m))) : 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = samples > 0 ? ahead_s * k / samples : 0;
    const Pose X{from_rotation_vector(V_WB_W.w * t) * X_WB.R, X_WB.p + V_WB_W.v * t};
    X_BW_.push_back(inverse(X));
  }
}

bool WallZone::holds(const Vector3d& p_W, double radius_m) const {
  return std::any_of(X_BW_.begin(), X_BW_.end(), [&](const Pose& X_BW) {
    const Vector3d p = X_BW * p_W;
    return (p.array() >= box_.min_m.array() - radius_m).all() &&
           (p.array() <= box_.max_m.array() + radius_m).all();
  });
}

Reach::Reach(std::vector<Mover> movers, double largest_m) : movers_(std::move(movers)) {
  double reach = 0;
  for (const Mover& m : movers_) reach = std::max(reach, m.radius_m + m.gap_m);
  cell_m_ = std::max(reach + largest_m, 1e-3);
  for (std::size_t k = 0; k < movers_.size(); ++k) {
    const Mover& m = movers_[k];
    cells_[cell(at(m.x), at(m.y), at(m.z))].push_back(k);
  }
}

int Reach::at(double x) const { return static_cast<int>(std::floor(x / cell_m_)); }

std::int64_t Reach::cell(int i, int j, int k) const {
  constexpr std::int64_t kSpan = 1 << 20;  // cells an axis
  return ((i + kSpan / 2) * kSpan + (j + kSpan / 2)) * kSpan + (k + kSpan / 2);
}

bool Reach::touches(const Vector3d& p, double radius_m) const {
  const int i = at(p.x()), j = at(p.y()), k = at(p.z());
  for (int a = i - 1; a <= i + 1; ++a)
    for (int b = j - 1; b <= j + 1; ++b)
      for (int c = k - 1; c <= k + 1; ++c) {
        const auto found = cells_.find(cell(a, b, c));
        if (found == cells_.end()) continue;
        for (const std::size_t n : found->second) {
          const Mover& m = movers_[n];
          const double reach = radius_m + m.radius_m + m.gap_m;
          if ((Vector3d(m.x, m.y, m.z) - p).squaredNorm() < reach * reach) return true;
        }
      }
  return false;
}

HoldPolicy::HoldPolicy(const HoldSettings& settings, std::size_t rocks)
    : settings_(settings), rest_(rocks, Rest::moving), calm_s_(rocks, 0.0F) {}

void HoldPolicy::observe(const std::vector<std::uint8_t>& flags, double dt_s) {
  for (std::size_t r = 0; r < rest_.size(); ++r) {
    const bool calm = (flags[r] & (rest_flag::busy | rest_flag::near | rest_flag::soon)) == 0;
    calm_s_[r] = calm ? calm_s_[r] + static_cast<float>(dt_s) : 0.0F;
  }
}

bool HoldPolicy::alarms(const std::vector<Rest>& rest, const std::vector<std::uint8_t>& flags) {
  for (std::size_t r = 0; r < rest.size(); ++r) {
    if (rest[r] != Rest::moving && (flags[r] & (rest_flag::near | rest_flag::struck)) != 0)
      return true;
    // Moving rock is about to touch what is not there.
    if (rest[r] == Rest::parked && (flags[r] & rest_flag::exposed) != 0) return true;
  }
  return false;
}

std::vector<Rest> HoldPolicy::decide(const std::vector<std::uint8_t>& flags) const {
  std::vector<Rest> next = rest_;
  for (std::size_t r = 0; r < next.size(); ++r) {
    if ((flags[r] & kWakes) != 0) {
      next[r] = Rest::moving;
    } else if (next[r] == Rest::moving && calm_s_[r] >= static_cast<float>(settings_.rest_s)) {
      next[r] = Rest::held;
    }
  }
  return next;
}

void HoldPolicy::park(std::vector<Rest>& rest, const std::vector<std::uint8_t>& flags) {
  for (std::size_t r = 0; r < rest.size(); ++r) {
    if (rest[r] == Rest::moving) continue;
    rest[r] = (flags[r] & rest_flag::exposed) != 0 ? Rest::held : Rest::parked;
  }
}

std::size_t HoldPolicy::changes(const std::vector<Rest>& rest) const {
  std::size_t n = 0;
  for (std::size_t r = 0; r < rest.size(); ++r) n += rest[r] != rest_[r];
  return n;
}

void HoldPolicy::adopt(std::vector<Rest> rest) {
  for (std::size_t r = 0; r < rest.size(); ++r)
    if (rest[r] == Rest::moving && rest_[r] != Rest::moving) calm_s_[r] = 0.0F;
  rest_ = std::move(rest);
}

}  // namespace dipper::dem
