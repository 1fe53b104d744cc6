// An operator who does what he is told from outside.
#pragma once

#include <array>

#include "mbs/operator.hpp"

namespace dipper::mbs {

/// Sends the drives from where they are sent to where an order (core::Order) has them at its time:
/// hoist, crowd, swing and door, four positions and then four rates. Between, each drive follows
/// the cubic polynomial with these positions and rates at both ends, and after it its last rate:
/// positions and rates have no jump. He looks at nothing himself. His time on the motion is the
/// clock's, for the record.
class ToldOperator final : public Operator {
 public:
  static constexpr std::size_t kDrives = 4;

  /// Stands still. \param at  where the drives are sent at t = 0
  explicit ToldOperator(const machine::Drives& at);

  /// Throws std::invalid_argument for an order of another length, or one that is late.
  void take(double t_s, const core::Order& order) override;
  void reset(double t_s, const std::vector<double>& state) override;
  void update(double, const std::function<Felt()>&) override {}
  std::vector<double> state(double t_s) const override;
  machine::DriveState setpoint(double t_s) const override;
  std::optional<double> motion_s(double) const override { return std::nullopt; }
  std::vector<core::Channel> channels() const override;
  std::vector<double> values(double t_s, const DriveEfforts& motors) const override;

 private:
  using Row = std::array<double, kDrives>;
  struct Sent {
    Row position{}, rate{}, acceleration{};
  };
  Sent sent(double t_s) const;

  double from_s_ = 0, by_s_ = 0;  ///< of the order
  Row position_{}, rate_{};       ///< when it came
  Row to_{}, to_rate_{};          ///< at its time
};

}  // namespace dipper::mbs
