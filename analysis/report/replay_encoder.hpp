// The replay in few bytes: positions as 16-bit steps of a box, as changes from frame to frame.
//
// A frame is 7 planes of N bytes, N the number of spheres: for x, y and z the low bytes, then the
// high bytes, of the change since the frame before (zigzag: 0, -1, 1, -2 ... as 0, 1, 2, 3 ...,
// modulo 65536; the first frame's change is from 0), then the speeds: 254 sqrt(v / v_max), and 255
// for a sphere that is not in this frame. Rock at rest is then zeros, and compresses to nothing.
//
// A position is sent again only when it is off by more than `kStill_m`; steps never add up an
// error, since changes are taken from what the reader has decoded.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "analysis/report/replay_source.hpp"

namespace dipper {

constexpr double kStill_m = 0.002;  ///< less than a pixel of the replay

/// What has to be known of all frames before the first is encoded.
class ReplayExtent {
 public:
  void add(const ReplayFrame& frame);

  BoundingBox box;  ///< of the centres
  double speed_max_m_s = 0;
  std::vector<ReplaySphere> spheres;  ///< one an id, as it was first seen

 private:
  std::unordered_map<std::int64_t, bool> seen_;
};

/// Keeps a sphere or leaves out its whole rock: one rock in `one_in`, the same ones in each frame.
bool shown(const ReplaySphere& sphere, std::size_t one_in);

class ReplayEncoder {
 public:
  /// `spheres` fixes which are encoded and in which order.
  ReplayEncoder(const ReplayExtent& extent, const std::vector<ReplaySphere>& spheres);

  /// Appends the frame's 7 N bytes to `out`.
  void encode(const ReplayFrame& frame, std::vector<std::uint8_t>& out);

  const Eigen::Vector3d& origin_m() const { return origin_; }
  const Eigen::Vector3d& step_m() const { return step_; }

 private:
  Eigen::Vector3d origin_, step_;
  double speed_max_;
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<std::array<std::uint16_t, 3>> sent_;
  bool first_ = true;
};

}  // namespace dipper
