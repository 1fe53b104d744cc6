// Who sends the drives where, when they have limits and so may not get there.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "coupler/core/server.hpp"
#include "machine/motion.hpp"
#include "mbs/limited_drives.hpp"

namespace dipper::mbs {

/// What he feels of the machine.
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

  /// Goes on at a time, s, from a state that `state` gave then.
  virtual void reset(double t_s, const std::vector<double>& state) = 0;

  /// Decides what to do from now on. \param feel  tells what he feels at that time, once it is
  /// asked
  virtual void update(double t_s, const std::function<Felt()>& feel) = 0;

  /// Is told what to do, at the start of a window. Throws std::invalid_argument: most are told
  /// nothing.
  virtual void take(double, const core::Order&) {
    throw std::invalid_argument("an order for drives that follow their motion");
  }

  /// All that he will decide by, besides what he sees; always as many numbers.
  virtual std::vector<double> state(double t_s) const = 0;

  /// The drives' set points at a time after the last update, at most a sub-step later: positions
  /// [m, rad], rates and accelerations per second.
  virtual machine::DriveState setpoint(double t_s) const = 0;

  /// Where on the case's motion he is, s; none when he follows another way.
  virtual std::optional<double> motion_s(double t_s) const = 0;

  /// What the record tells of him, and its values at a time.
  virtual std::vector<core::Channel> channels() const = 0;
  virtual std::vector<double> values(double t_s, const DriveEfforts& motors) const = 0;
};

}  // namespace dipper::mbs
