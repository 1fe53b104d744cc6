// The motion of a body.
#pragma once

#include <vector>

#include "common/frames.hpp"

namespace dipper::analysis::rock {

/// A body's poses against time, and its twists where they are known.
class PoseTrack {
 public:
  PoseTrack() = default;
  /// Times must increase. Missing twists are computed from the poses.
  PoseTrack(std::vector<double> time_s, std::vector<Pose> X_WB, std::vector<Twist> V_WB_W = {});

  bool empty() const { return time_s_.empty(); }
  double start_s() const { return time_s_.front(); }
  double end_s() const { return time_s_.back(); }

  /// Between two times the body moves at constant twist. Before the first and after the last time
  /// it has the pose and the twist of that time.
  BodyState at(double t) const;

 private:
  std::vector<double> time_s_;
  std::vector<Pose> X_WB_;
  std::vector<Twist> V_WB_W_;
};

/// The velocity of a point of a body, in W [m/s].
inline Vector3d velocity_at(const BodyState& body, const Vector3d& p_W) {
  return body.V_WB_W.v + body.V_WB_W.w.cross(p_W - body.X_WB.p);
}

}  // namespace dipper::analysis::rock
