#include "analysis/rock/pose_track.hpp"

#include <algorithm>
#include <stdexcept>

namespace dipper::analysis::rock {

PoseTrack::PoseTrack(std::vector<double> time_s, std::vector<Pose> X_WB, std::vector<Twist> V_WB_W)
    : time_s_(std::move(time_s)), X_WB_(std::move(X_WB)), V_WB_W_(std::move(V_WB_W)) {
  if (X_WB_.size() != time_s_.size() || (!V_WB_W_.empty() && V_WB_W_.size() != time_s_.size()))
    throw std::invalid_argument("poses and times of different lengths");
  if (!std::is_sorted(time_s_.begin(), time_s_.end()))
    throw std::invalid_argument("times of poses must increase");
}

BodyState PoseTrack::at(double t) const {
  const auto after = std::lower_bound(time_s_.begin(), time_s_.end(), t);
  const auto k = static_cast<std::size_t>(after - time_s_.begin());
  const bool inside = k > 0 && k < time_s_.size() && time_s_[k] > time_s_[k - 1];
  if (!inside) {
    const std::size_t end = std::min(k, time_s_.size() - 1);
    BodyState s{X_WB_[end], {}};
    if (!V_WB_W_.empty()) s.V_WB_W = V_WB_W_[end];
    return s;
  }
  const double dt = time_s_[k] - time_s_[k - 1], share = (t - time_s_[k - 1]) / dt;
  BodyState s;
  s.X_WB.p = (1 - share) * X_WB_[k - 1].p + share * X_WB_[k].p;
  s.X_WB.R = X_WB_[k - 1].R.slerp(share, X_WB_[k].R);
  if (V_WB_W_.empty()) {
    s.V_WB_W = twist_between(X_WB_[k - 1], X_WB_[k], dt);
  } else {
    s.V_WB_W.w = (1 - share) * V_WB_W_[k - 1].w + share * V_WB_W_[k].w;
    s.V_WB_W.v = (1 - share) * V_WB_W_[k - 1].v + share * V_WB_W_[k].v;
  }
  return s;
}

}  // namespace dipper::analysis::rock
