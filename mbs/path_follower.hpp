// The operator who follows the motion, and slows down when a drive stalls.
#pragma once

#include <memory>

#include "mbs/operator.hpp"

namespace dipper::mbs {

/// How far along the motion an operator is.
struct PathState {
  double time = 0;         ///< s of the motion: where on it the drives are sent to
  double rate = 1;         ///< of that against the clock, 0 ... 1
  double relief = 0;       ///< m by which the crowd is sent less far out than the motion says
  double relief_rate = 0;  ///< m/s
};

/// What is asked of a follower besides.
struct PathWish {
  double rate = 1;                   ///< at most
  std::optional<double> crowd_back;  ///< rate of the relief where the crowd does not stall, m/s; a
                                     ///< larger one that a stall asks for counts
};

/// Slows down along the motion while a drive cannot follow, so that the dipper takes the planned
/// way, later. Updates once a sub-step; in between, rates change linearly, so that the setpoints
/// have no jump of speed.
///
/// r is the overload; e = 0 for r <= 1 and rises to 1 at r = 1.5. Rates approach their targets with
/// the reaction time 0.2 s. The target of the rate along the motion is
///   rate = min(1 - e_others, 1 - 0.75 e_crowd):
/// the operator waits for a hoist or swing that cannot follow. A crowd that stalls is normal in a
/// dig: the operator keeps hoisting, at a quarter of the rate, and retracts the crowd as it is
/// pushed back,
///   relief_rate = 0.5 m/s (r_crowd - 1.4) / 0.1, within 0 ... 0.5 m/s.
/// Where the motion nearly stops all the same (rate < 0.2), the crowd retracts for a shallower
/// cut,
///   relief_rate = 0.1 m/s (1 - rate / 0.2),
/// and otherwise extends it again, relief_rate = -(1 - e_crowd) relief / 2 s. The motion never runs
/// backwards, and the crowd does not retract beyond its stop.
class PathFollower final : public Operator {
 public:
  static constexpr double kReaction_s = 0.2;  ///< of a hand on a lever
  static constexpr double kGiveOut_s = 2.0;   ///< in which the relief of the crowd ends

  /// \param crowd_min  m, the crowd's stop
  PathFollower(std::shared_ptr<const machine::Motion> motion, double crowd_min);

  /// Rates stay constant until the next update. \param state  a PathState's four numbers
  void reset(double t_s, const std::vector<double>& state) override;
  void update(double t_s, const std::function<Felt()>& feel) override {
    ease(t_s, [&] { return feel().motors.overload(); });
  }
  std::string kind() const override { return "limited, following the motion"; }
  std::vector<double> state(double t_s) const override;
  machine::DriveState setpoint(double t_s) const override;
  std::optional<double> motion_s(double t_s) const override { return at(t_s).time; }
  std::vector<core::Channel> channels() const override;
  std::vector<double> values(double t_s, const DriveEfforts& motors) const override;

  /// Sets new rates at a time. \param overload  of the drives at that time, after the update
  /// \param wish  asked for after that
  void ease(
      double t_s, const std::function<Overload()>& overload,
      const std::function<PathWish()>& wish = [] { return PathWish{}; });

  /// The state at a time after the last update, at most a sub-step later.
  PathState at(double t_s) const;

 private:
  void go_on(double t_s, const PathState& from);

  std::shared_ptr<const machine::Motion> motion_;
  double crowd_min_;
  double updated_s_ = 0;
  PathState then_;
  double rate_slope_ = 0, relief_slope_ = 0;  ///< 1/s, m/s^2, since then
};

}  // namespace dipper::mbs
