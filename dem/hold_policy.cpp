#include "dem/hold_policy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dipper::dem {
namespace {

constexpr std::uint8_t kWakes = rest_flag::near | rest_flag::soon | rest_flag::disturbed;

}  // namespace

WallZone::WallZone(const Box& box, const Pose& X_WB, const Twist& V_WB_W, double ahead_s,
                   double margin_m)
    : box_(box.grown(margin_m)) {
  const double size = box.sides_m().norm() / 2;
  const double way = (V_WB_W.v.norm() + V_WB_W.w.norm() * size) * ahead_s;
  const int samples = ahead_s > 0 ? std::max(1, static_cast<int>(std::ceil(way / margin_m))) : 0;
  for (int k = 0; k <= samples; ++k) {
    const double t = samples > 0 ? ahead_s * k / samples : 0;
    const Pose X{from_rotation_vector(V_WB_W.w * t) * X_WB.R, X_WB.p + V_WB_W.v * t};
    X_BW_.push_back(inverse(X));
  }
}

bool WallZone::holds(const Vector3d& p_W, double radius_m) const {
  const Box box = box_.grown(radius_m);
  return std::any_of(X_BW_.begin(), X_BW_.end(),
                     [&](const Pose& X_BW) { return box.holds(X_BW * p_W); });
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

std::vector<Rest> HoldPolicy::all() const {
  std::vector<Rest> rest;
  rest.reserve(rocks_.size());
  for (const RestRecord& r : rocks_) rest.push_back(r.rest);
  return rest;
}

void HoldPolicy::keep_flags(std::uint8_t bits) {
  for (RestRecord& r : rocks_) r.flags &= bits;
}

std::vector<std::uint8_t> HoldPolicy::flags() const {
  std::vector<std::uint8_t> flags;
  flags.reserve(rocks_.size());
  for (const RestRecord& r : rocks_) flags.push_back(r.flags);
  return flags;
}

void HoldPolicy::set_flags(const std::vector<std::uint8_t>& flags) {
  for (std::size_t k = 0; k < rocks_.size(); ++k) rocks_[k].flags = flags[k];
}

void HoldPolicy::observe(double dt_s) {
  for (RestRecord& r : rocks_) {
    const bool calm = (r.flags & (rest_flag::busy | rest_flag::near | rest_flag::soon)) == 0;
    r.calm_s = calm ? r.calm_s + static_cast<float>(dt_s) : 0.0F;
  }
}

bool HoldPolicy::alarms() const {
  return std::any_of(rocks_.begin(), rocks_.end(), [](const RestRecord& r) {
    if (r.rest != Rest::moving && (r.flags & (rest_flag::near | rest_flag::struck)) != 0)
      return true;
    // Moving rock is about to touch what is not there.
    return r.rest == Rest::parked && (r.flags & rest_flag::exposed) != 0;
  });
}

std::vector<Rest> HoldPolicy::decide() const {
  std::vector<Rest> next = all();
  for (std::size_t k = 0; k < next.size(); ++k) {
    if ((rocks_[k].flags & kWakes) != 0) {
      next[k] = Rest::moving;
    } else if (next[k] == Rest::moving &&
               rocks_[k].calm_s >= static_cast<float>(settings_.rest_s)) {
      next[k] = Rest::held;
    }
  }
  return next;
}

void HoldPolicy::park(std::vector<Rest>& rest) const {
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k] == Rest::moving) continue;
    rest[k] = (rocks_[k].flags & rest_flag::exposed) != 0 ? Rest::held : Rest::parked;
  }
}

std::size_t HoldPolicy::changes(const std::vector<Rest>& rest) const {
  std::size_t n = 0;
  for (std::size_t k = 0; k < rest.size(); ++k) n += rest[k] != rocks_[k].rest;
  return n;
}

void HoldPolicy::adopt(const std::vector<Rest>& rest) {
  for (std::size_t k = 0; k < rest.size(); ++k) {
    RestRecord& r = rocks_[k];
    if (rest[k] == Rest::moving && r.rest != Rest::moving) r.calm_s = 0.0F;
    r.rest = rest[k];
  }
}

}  // namespace dipper::dem
