// The operator when a program drives: limited drives follow its orders.
#pragma once

#include <array>

#include "mbs/operator.hpp"

namespace dipper::mbs {

/// Moves the set points of hoist, crowd, swing and door from their current values to those of an
/// order (core::Order: four positions, then four rates) at the order's time. In between, each set
/// point follows the cubic polynomial with these positions and rates at both ends; after that time
/// it continues at its last rate. So set points and their rates have no jump.
class ProgramOperator final : public Operator {
 public:
  static constexpr std::size_t kDrives = 4;

  /// At rest until the first order. \param at  the set points at t = 0
  explicit ProgramOperator(const machine::Drives& at);

  /// Throws std::invalid_argument for an order of another length, or one that is late.
  void take(double t_s, const core::Order& order) override;
  void reset(double t_s, const std::vector<double>& state) override;
  void update(double, const std::function<Felt()>&) override {}
  std::string kind() const override { return "limited, led by a program"; }
  std::vector<double> state(double t_s) const override;
  machine::DriveState setpoint(double t_s) const override;
  std::optional<double> motion_s(double) const override { return std::nullopt; }
  std::vector<core::Channel> channels() const override;
  std::vector<double> values(double t_s, const DriveEfforts& motors) const override;

 private:
  using Row = std::array<double, kDrives>;
  struct Point {
    Row position{}, rate{}, acceleration{};
  };
  Point point(double t_s) const;

  double from_s_ = 0, by_s_ = 0;  ///< the order's arrival and its time
  Row position_{}, rate_{};       ///< set points at arrival
  Row to_{}, to_rate_{};          ///< set points at its time
};

}  // namespace dipper::mbs
