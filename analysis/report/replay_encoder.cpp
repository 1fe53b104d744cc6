#include "analysis/report/replay_encoder.hpp"

#include <algorithm>
#include <cmath>

namespace dipper {
namespace {

constexpr double kSteps = 65535;
constexpr double kSpeedSteps = 254;
constexpr std::uint8_t kAbsent = 255;

std::uint16_t zigzag(std::uint16_t change) {
  const bool negative = change & 0x8000u;
  return static_cast<std::uint16_t>(change << 1) ^ static_cast<std::uint16_t>(negative ? -1 : 0);
}

/// 64-bit finaliser of MurmurHash3: neighbours in number are no neighbours in order.
std::uint64_t scramble(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdULL;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

}  // namespace

void ReplayExtent::add(const ReplayFrame& frame) {
  for (const auto& s : frame.spheres) {
    box.add(s.p_m.cast<double>());
    speed_max_m_s = std::max(speed_max_m_s, static_cast<double>(s.v_m_s.norm()));
    if (seen_.emplace(s.id, true).second) spheres.push_back(s);
  }
}

bool shown(const ReplaySphere& sphere, std::size_t one_in) {
  // Sphere and clump numbers overlap: a clump's are taken as negative.
  const std::int64_t rock = sphere.rock >= 0 ? -1 - sphere.rock : sphere.id;
  return one_in <= 1 || scramble(static_cast<std::uint64_t>(rock)) % one_in == 0;
}

ReplayEncoder::ReplayEncoder(const ReplayExtent& extent, const std::vector<ReplaySphere>& spheres)
    : origin_(extent.box.min),
      step_((extent.box.max - extent.box.min) / kSteps),
      speed_max_(extent.speed_max_m_s),
      sent_(spheres.size(), {0, 0, 0}) {
  if (spheres.empty()) origin_ = step_ = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < spheres.size(); ++i) index_[spheres[i].id] = i;
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
}

}  // namespace dipper
