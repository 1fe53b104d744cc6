// The messages between the two sides and the master, independent of the transport.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "coupler/core/server.hpp"

namespace dipper::core {

/// The header of every message.
struct Envelope {
  std::string run_id;
  std::string case_hash;
  std::int64_t step_index = 0;
  std::int64_t sequence = 0;
  std::int64_t t_ns = 0;
};

/// To the rock: the walls' initial poses.
struct RockPlace {
  std::vector<Pose> X_WB;
};

enum class Action {
  hello = 1,
  state = 2,
  save = 3,
  load = 4,
  hash = 5,
  stop = 6,
  look = 7,
  follow = 8
};

/// To either side. `state`: of the machine now, with the poses extrapolated to the envelope's t_ns.
struct Command {
  Action action = Action::hello;
  std::string text;  ///< save, load: the file; look: the grid; follow: rows of a motion
};

/// From either side.
struct Status {
  bool ok = true;
  std::string text;
};

/// While a message travels, the envelope has the window's step_index and end; a decoded step has
/// them too.
using Body =
    std::variant<MachineStep, MachineState, RockPlace, RockStep, RockState, Command, Status>;

struct Message {
  Envelope envelope;
  Body body;
};

/// Throws std::runtime_error naming `side`, the sync step, the simulated time, the body and the
/// quantity when a pose, twist or wrench has a NaN, an infinity, or an invalid rotation. `bodies`
/// are names for that message.
void require_sound(const Message& m, const std::string& side,
                   const std::vector<std::string>& bodies);

}  // namespace dipper::core
