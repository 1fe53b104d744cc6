// The operator of drives with limits: sends them set points that they may not reach.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/core/server.hpp"
#include "machine/motion.hpp"
#include "mbs/limited_drives.hpp"

namespace dipper::mbs {

/// What the operator feels of the machine.
struct Felt {
  machine::DriveState drives;  ///< where they are, and how fast; no accelerations
  DriveEfforts motors;
};

/// Sends limited drives somewhere. The shovel calls, in this order: `reset` at the start of a run
/// and where it goes on; then for each sub-step `update` at its start, `setpoint` at any time up to
/// its end, and `state` at the end, which is in the checkpoints. The same state at the same time
/// that feels the same gives the same set points to the bit.
class Operator {
 public:
  virtual ~Operator() = default;

  /// Continues at a time, s, from a state that `state` returned at that time.
  virtual void reset(double t_s, const std::vector<double>& state) = 0;

  /// Decides the set points from now on. \param feel  what the operator feels at that time,
  /// computed when called
  virtual void update(double t_s, const std::function<Felt()>& feel) = 0;

  /// Takes an order at the start of a sync step. Throws std::invalid_argument unless a program
  /// drives.
  virtual void take(double, const core::Order&) {
    throw std::invalid_argument("an order for drives that follow their motion");
  }

  /// The kind of its drives in checkpoints, a few words: another kind cannot continue its state.
  virtual std::string kind() const = 0;

  /// All that later decisions depend on, except measurements; always the same count of numbers.
  virtual std::vector<double> state(double t_s) const = 0;

  /// The drives' set points at a time after the last update, at most a sub-step later: positions
  /// [m, rad], rates and accelerations per second.
  virtual machine::DriveState setpoint(double t_s) const = 0;

  /// The operator's time on the case's motion, s; none when it is not followed.
  virtual std::optional<double> motion_s(double t_s) const = 0;

  /// The operator's channels of the record, and their values at a time.
  virtual std::vector<core::Channel> channels() const = 0;
  virtual std::vector<double> values(double t_s, const DriveEfforts& motors) const = 0;
};

}  // namespace dipper::mbs
