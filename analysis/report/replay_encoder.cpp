#include "analysis/report/replay_encoder.hpp"

#include <algorithm>
#include <cmath>

namespace dipper::analysis::report {
namespace {

constexpr double kSteps = 65535;
constexpr double kSpeedSteps = 254;
constexpr std::uint8_t kAbsent = 255;
constexpr double kDecades = 5;  // of a wall's field

std::uint8_t decades_byte(double x, double most) {
  if (!(x > 0) || x < most * std::pow(10, -kDecades)) return 0;
  return static_cast<std::uint8_t>(1 + std::lround(254 * (1 + std::log10(x / most) / kDecades)));
}

std::uint16_t zigzag(std::uint16_t change) {
  const bool negative = change & 0x8000u;
  return static_cast<std::uint16_t>(change << 1) ^ static_cast<std::uint16_t>(negative ? -1 : 0);
}

/// MurmurHash3, 64 bit: neighbours in number are not neighbours in order.
std::uint64_t murmur3_finaliser(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

}  // namespace

bool shown(const ReplaySphere& sphere, std::size_t one_in) {
  // Sphere and clump numbers overlap: a clump's are taken as negative.
  const std::int64_t rock = sphere.rock >= 0 ? -1 - sphere.rock : sphere.id;
  return murmur3_finaliser(static_cast<std::uint64_t>(rock)) <= ~std::uint64_t{0} / one_in;
}

void ReplayExtent::add(const ReplaySphere& s) {
  box.add(s.p_m.cast<double>());
  speed_max_m_s = std::max(speed_max_m_s, static_cast<double>(s.v_m_s.norm()));
  if (!shown(s, one_in) || !seen_.insert(s.id).second) return;
  spheres.push_back(s);
  while (spheres.size() > spheres_max_) {
    ++one_in;
    const auto gone = std::stable_partition(
        spheres.begin(), spheres.end(), [&](const ReplaySphere& x) { return shown(x, one_in); });
    std::for_each(gone, spheres.end(), [&](const ReplaySphere& x) { seen_.erase(x.id); });
    spheres.erase(gone, spheres.end());
  }
}

void ReplayExtent::add_values(const ReplayFrame& frame, const std::vector<ReplayWall>& walls) {
  for (std::size_t w = 0; w < walls.size(); ++w) {
    for (std::size_t k = 0; k < walls[w].fields.size(); ++k) {
      double& most = field_max[walls[w].fields[k]];
      for (const float x : frame.values[w][k]) most = std::max(most, static_cast<double>(x));
    }
  }
}

ReplayEncoder::ReplayEncoder(const ReplayExtent& extent, const std::vector<ReplaySphere>& spheres,
                             const std::vector<ReplayWall>& walls)
    : origin_(extent.box.min_m),
      step_(extent.box.sides_m() / kSteps),
      speed_max_(extent.speed_max_m_s),
      sent_(spheres.size(), {0, 0, 0}) {
  if (spheres.empty()) origin_ = step_ = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < spheres.size(); ++i) index_[spheres[i].id] = i;
  for (const auto& wall : walls) {
    auto& most = field_max_.emplace_back();
    for (const auto& field : wall.fields) most.push_back(extent.field_max.at(field));
  }
}

void ReplayEncoder::encode(const ReplayFrame& frame, std::vector<std::uint8_t>& out) {
  const std::size_t n = sent_.size(), at = out.size();
  out.resize(at + 7 * n, 0);
  std::uint8_t* planes = out.data() + at;
  std::fill(planes + 6 * n, planes + 7 * n, kAbsent);
  for (const auto& s : frame.spheres) {
    const auto found = index_.find(s.id);
    if (found == index_.end()) continue;
    const std::size_t i = found->second;
    for (int axis = 0; axis < 3; ++axis) {
      if (step_[axis] <= 0) continue;  // all spheres share this coordinate
      const double x = static_cast<double>(s.p_m[axis]) - origin_[axis];
      std::uint16_t& sent = sent_[i][static_cast<std::size_t>(axis)];
      if (!first_ && std::abs(x - sent * step_[axis]) <= kStill_m) continue;
      const auto steps =
          static_cast<std::uint16_t>(std::clamp(std::round(x / step_[axis]), 0.0, kSteps));
      const std::uint16_t change = zigzag(static_cast<std::uint16_t>(steps - sent));
      sent = steps;
      planes[static_cast<std::size_t>(2 * axis) * n + i] = static_cast<std::uint8_t>(change);
      planes[static_cast<std::size_t>(2 * axis + 1) * n + i] =
          static_cast<std::uint8_t>(change >> 8);
    }
    const double v = speed_max_ > 0 ? static_cast<double>(s.v_m_s.norm()) / speed_max_ : 0.0;
    planes[6 * n + i] = static_cast<std::uint8_t>(std::lround(kSpeedSteps * std::sqrt(v)));
  }
  first_ = false;
  for (std::size_t w = 0; w < field_max_.size(); ++w) {
    for (std::size_t k = 0; k < field_max_[w].size(); ++k) {
      for (const float x : frame.values[w][k])
        out.push_back(decades_byte(static_cast<double>(x), field_max_[w][k]));
    }
  }
}

}  // namespace dipper::analysis::report
