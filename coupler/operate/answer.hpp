// What a program says when it is asked where the drives are to go.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "coupler/core/server.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::operate {

struct Answer {
  core::Order order;
  bool done = false;  ///< the run may end
};

/// A line as JSON. Throws std::runtime_error with the begin of the line.
nlohmann::json parsed(const std::string& line);

/// Reads answers for one machine. Pure.
class AnswerReader {
 public:
  /// \param rake  handle centre line to dipper floor, rad
  AnswerReader(const machine::MachineData& machine, double rake);

  /// An answer of what is to be at `by_ns`, given at `t_ns` with the drives sent to `sent`. A rate
  /// that is not given is the mean one until then. Throws std::runtime_error that names the key,
  /// what is wrong with it and what would be right: a key that lacks or is not known, what is no
  /// finite number, a position or a speed beyond the machine's limits, and a position of hoist and
  /// crowd at which the ropes have no path.
  Answer read(const std::string& line, std::int64_t t_ns, std::int64_t by_ns,
              const machine::Drives& sent) const;

 private:
  machine::MachineData machine_;
  machine::ShovelKinematics shovel_;
};

}  // namespace dipper::operate
