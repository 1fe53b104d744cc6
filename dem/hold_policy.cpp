#include "dem/hold_policy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dipper::dem {
namespace {

constexpr std::uint8_t kWakes = rest_flag::near | rest_flag::soon | rest_flag::disturbed;
/// Of a unit cube: so much farther a turned box that grows by 1 may reach.
constexpr double kDiagonal = 1.7321;
constexpr double kRounding_m = 1e-6;

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
    for (int corner = 0; corner < Box::kCorners; ++corner) around_W_.add(X * box_.corner(corner));
  }
}

bool WallZone::holds(const Vector3d& p_W, double radius_m) const {
  if (!around_W_.grown(kDiagonal * radius_m + kRounding_m).holds(p_W)) return false;
  const Box box = box_.grown(radius_m);
  return std::any_of(X_BW_.begin(), X_BW_.end(),
                     [&](const Pose& X_BW) { return box.holds(X_BW * p_W); });
}

Reach::Reach(std::vector<Mover> movers, double largest_m) {
  if (movers.empty()) return;
  double reach = 0;
  for (const Mover& m : movers) {
    reach = std::max(reach, m.radius_m + m.gap_m);
    box_.add({m.x, m.y, m.z});
  }
  // A rock far away must not need many cells.
  const double most = 8.0 * static_cast<double>(movers.size()) + 1000;
  double count = 0;
  for (cell_m_ = std::max((reach + largest_m) / kAround, 1e-3);; cell_m_ *= 1.25) {
    const Eigen::Array3d n = (box_.sides_m().array() / cell_m_).floor() + 1 + 2 * kAround;
    count = n.prod();
    if (count > most) continue;
    for (int k = 0; k < 3; ++k) cells_[k] = static_cast<int>(n[k]);
    break;
  }
  box_.min_m.array() -= kAround * cell_m_;
  first_.assign(static_cast<std::size_t>(count) + 1, 0);
  std::vector<std::size_t> cell_of;
  cell_of.reserve(movers.size());
  for (const Mover& m : movers) {
    cell_of.push_back(at(static_cast<int>(cell(0, m.x)), static_cast<int>(cell(1, m.y)),
                         static_cast<int>(cell(2, m.z))));
    ++first_[cell_of.back() + 1];
  }
  // Along each axis in turn, so that a cell includes all movers around it.
  near_.assign(static_cast<std::size_t>(count), 0);
  for (std::size_t c = 0; c < near_.size(); ++c) near_[c] = first_[c + 1] > 0 ? 1 : 0;
  for (const int stride : {1, cells_[0], cells_[0] * cells_[1]}) {
    const std::vector<char> was = near_;
    for (std::size_t way = 1; way <= kAround; ++way) {
      const std::size_t apart = way * static_cast<std::size_t>(stride);
      for (std::size_t c = apart; c < near_.size(); ++c) {
        near_[c] |= was[c - apart];
        near_[c - apart] |= was[c];
      }
    }
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  movers_.resize(movers.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t m = 0; m < movers.size(); ++m) movers_[next[cell_of[m]]++] = movers[m];
}

bool Reach::touches(const Vector3d& p, double radius_m) const {
  if (movers_.empty()) return false;
  const double x = cell(0, p.x()), y = cell(1, p.y()), z = cell(2, p.z());
  const auto inside = [&](double c, int axis) { return c >= 0 && c < cells_[axis]; };
  if (!inside(x, 0) || !inside(y, 1) || !inside(z, 2)) return false;
  const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
  if (near_[at(i, j, k)] == 0) return false;
  const int from = std::max(i - kAround, 0), to = std::min(i + kAround, cells_[0] - 1);
  for (int c = std::max(k - kAround, 0); c <= std::min(k + kAround, cells_[2] - 1); ++c)
    for (int b = std::max(j - kAround, 0); b <= std::min(j + kAround, cells_[1] - 1); ++b) {
      const std::uint32_t end = first_[at(to, b, c) + 1];
      for (std::uint32_t n = first_[at(from, b, c)]; n < end; ++n) {
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
    // Moving rock is about to touch parked rock.
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
