// What the two sides and the master say to each other, independent of how it travels.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "coupler/core/server.hpp"

namespace dipper::core {

/// In front of every message.
struct Envelope {
  std::string run_id;
  std::string case_hash;
  std::int64_t step_index = 0;
  std::int64_t sequence = 0;
  std::int64_t t_ns = 0;
};

/// To the rock: where its walls start.
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

/// To either side. `state`: of the machine now, and where it will be at the envelope's t_ns.
struct Command {
  Action action = Action::hello;
  std::string text;  ///< save, load: the file; look: the grid; follow: rows of a motion
};

/// From either side.
struct Status {
  bool ok = true;
  std::string text;
};

/// A window's step_index and end are in the envelope as it travels, and in the step once decoded.
using Body =
    std::variant<MachineStep, MachineState, RockPlace, RockStep, RockState, Command, Status>;

struct Message {
  Envelope envelope;
  Body body;
};

/// Throws std::runtime_error naming `side`, the sync step, the simulated time, the body and the
/// quantity when a pose, twist or wrench has a NaN, an infinity, or a rotation that is not one.
/// `bodies` are the names, for the message only.
void require_sound(const Message& m, const std::string& side,
                   const std::vector<std::string>& bodies);

}  // namespace dipper::core
