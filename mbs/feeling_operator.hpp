// The operator that follows a planned pass and adapts it to the forces of the dig.
#pragma once

#include <memory>

#include "machine/handle_statics.hpp"
#include "mbs/dig_rules.hpp"
#include "mbs/path_follower.hpp"

namespace dipper::mbs {

/// Follows the motion as a PathFollower, and changes it by the rules of dig_rules.hpp. The load is
/// estimated from hoist and crowd as if the machine stood still, with a time constant of 0.5 s, and
/// not while the crowd stalls, when the face pushes on more than the teeth. Changes decay with a
/// time constant of 2 s. The crowd goes out by at most 0.6 m beyond the motion.
class FeelingOperator final : public Operator {
 public:
  /// \param full_kg  what the dipper takes
  FeelingOperator(std::shared_ptr<const machine::Motion> motion,
                  const machine::MachineData& machine, double rake, double full_kg);

  /// \param state  of the path follower, then lift, its rate, the load, and whether it has landed
  void reset(double t_s, const std::vector<double>& state) override;
  void update(double t_s, const std::function<Felt()>& feel) override;
  std::string kind() const override { return "limited, with rules of the dig"; }
  std::vector<double> state(double t_s) const override;
  machine::DriveState setpoint(double t_s) const override;
  std::optional<double> motion_s(double t_s) const override { return path_.motion_s(t_s); }
  std::vector<core::Channel> channels() const override;
  std::vector<double> values(double t_s, const DriveEfforts& motors) const override;

 private:
  /// The changes besides those of the path follower, at a time; rates are linear in between.
  struct Change {
    double lift = 0, lift_rate = 0;  ///< rope drawn in beyond the motion, m; m/s
    double load_kg = 0;
  };
  Change at(double t_s) const;
  DigFeel feel(const Felt& felt, const PathState& path);

  std::shared_ptr<const machine::Motion> motion_;
  machine::HandleStatics statics_;
  DigLimits limits_;
  double crowd_max_;
  PathFollower path_;
  double updated_s_ = 0;
  Change then_;
  bool landed_ = false;
  double lift_slope_ = 0, load_slope_ = 0;  ///< m/s^2, kg/s, since then
};

}  // namespace dipper::mbs
