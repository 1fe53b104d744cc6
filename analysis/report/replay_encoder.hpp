// The replay in few bytes: positions as 16-bit steps of a box, as changes from frame to frame.
//
// A frame is 7 planes of N bytes, N the number of spheres: for x, y and z the low bytes, then the
// high bytes, of the change since the frame before (zigzag: 0, -1, 1, -2 ... as 0, 1, 2, 3 ...,
// modulo 65536; the first frame's change is from 0), then the speeds: 254 sqrt(v / v_max), and 255
// for a sphere that is not in this frame. Rock at rest is then zeros, and compresses to almost
// nothing.
//
// After them come the values of the walls' fields, wall by wall, field by field, a byte a triangle:
// 1 + 254 (1 + log10(x / x_max) / 5), x_max the field's largest on any wall in any frame; 0 for
// less than a hundred-thousandth of it. Teeth are pressed ten thousand times harder than the roof.
//
// A position is sent again only when it is off by more than `kStill_m`; steps never add up an
// error, since changes are taken from what the reader has decoded.
#pragma once

#include <cstdint>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "analysis/report/replay_source.hpp"
#include "common/box.hpp"

namespace dipper::analysis::report {

constexpr double kStill_m = 0.002;  ///< less than a pixel of the replay

/// Keeps a sphere or leaves out its whole rock: one rock in `one_in`, the same ones in each frame,
/// and of these the same ones that a larger `one_in` keeps.
bool shown(const ReplaySphere& sphere, std::size_t one_in);

/// Data of all frames that are needed before the first is encoded. It stores no more than
/// `spheres_max` spheres: `one_in` grows, as they come, to the smallest that keeps to that.
class ReplayExtent {
 public:
  explicit ReplayExtent(std::size_t spheres_max) : spheres_max_(spheres_max) {}

  void add(const ReplaySphere& sphere);
  void add_values(const ReplayFrame& frame, const std::vector<ReplayWall>& walls);

  Box box;  ///< of all centres
  double speed_max_m_s = 0;
  std::map<std::string, double> field_max;  ///< of the walls' fields, by name
  std::size_t one_in = 1;
  std::vector<ReplaySphere> spheres;  ///< those shown, one an id, as it was first seen

 private:
  std::size_t spheres_max_;
  std::unordered_set<std::int64_t> seen_;
};

class ReplayEncoder {
 public:
  /// `spheres` fixes which are encoded and in which order.
  ReplayEncoder(const ReplayExtent& extent, const std::vector<ReplaySphere>& spheres,
                const std::vector<ReplayWall>& walls);

  /// Appends the frame's 7 N bytes and its walls' to `out`.
  void encode(const ReplayFrame& frame, std::vector<std::uint8_t>& out);

  const Eigen::Vector3d& origin_m() const { return origin_; }
  const Eigen::Vector3d& step_m() const { return step_; }

 private:
  Eigen::Vector3d origin_, step_;
  double speed_max_;
  std::vector<std::vector<double>> field_max_;  ///< of each wall's fields
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<std::array<std::uint16_t, 3>> sent_;
  bool first_ = true;
};

}  // namespace dipper::analysis::report
