// Who sends the drives where: along the motion as it stands, or an operator who eases off.
#pragma once

#include <functional>
#include <memory>

#include "machine/motion.hpp"

namespace dipper::mbs {

/// How far along the motion an operator is.
struct PathState {
  double time = 0;         ///< s of the motion: where on it the drives are sent to
  double rate = 1;         ///< of that against the clock, 0 ... 1
  double relief = 0;       ///< m by which the crowd is sent less far out than the motion says
  double relief_rate = 0;  ///< m/s
};

/// What a drive wants over what it can do, of those that push the way they are sent.
struct Overload {
  double crowd = 0;
  double others = 0;  ///< the larger of hoist's and swing's
};

/// Watches the drives and slows the way along the motion while one of them cannot follow, so that
/// the dipper goes where it was sent, later. He looks once a sub-step; in between his rates change
/// evenly, so that where he sends the drives has no jump of speed.
///
/// With r the overload, e = 0 for r <= 1, rising to 1 at r = 1.5, and T = 0.2 s his reaction,
/// with which rates go to what he wants, he wants
///   rate = min(1 - e_others, 1 - 0.75 e_crowd):
/// for a hoist or swing that cannot follow he waits, while a crowd that stalls is what digging is
/// like: he lifts on, at a quarter of the rate, and lets the crowd come along as far as it gets:
///   relief_rate = 0.5 m/s (r_crowd - 1.4) / 0.1, within 0 ... 0.5 m/s.
/// Where the way nearly stands all the same (rate < 0.2) he lets the crowd back for a shallower
/// cut,
///   relief_rate = 0.1 m/s (1 - rate / 0.2),
/// and where neither is so he gives it out again, relief_rate = -(1 - e_crowd) relief / 2 s. The
/// way is never gone back, and the crowd not let back beyond its stop.
class Operator {
 public:
  /// \param crowd_min  m, the crowd's stop
  Operator(std::shared_ptr<const machine::Motion> motion, double crowd_min);

  /// Where he stands at a time; nothing changes before he looks.
  void stand(double t_s, const PathState& state);

  /// He looks at a time. \param overload  then, as he stands there
  void look(double t_s, const std::function<Overload()>& overload);

  /// Where he is at a time after the last look, and at most a sub-step later.
  PathState at(double t_s) const;

  /// Where he sends the drives then: position, rate and acceleration against the clock.
  machine::DriveState sent(double t_s) const;

 private:
  std::shared_ptr<const machine::Motion> motion_;
  double crowd_min_;
  double looked_s_ = 0;
  PathState then_;
  double rate_slope_ = 0, relief_slope_ = 0;  ///< 1/s, m/s^2, since then
};

}  // namespace dipper::mbs
