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

/// To the rock: targets (only poses count). From the machine: its state.
struct TargetMotion {
  std::int64_t n_steps = 0;  ///< 0: place the walls
  std::vector<BodyState> bodies;
  std::vector<double> channels;
  bool contact = true;  ///< whether the bodies meet rock on the way there; from then on
};

/// From the rock: what it did. To the machine: hold bodies[].mean until the envelope's t_ns.
struct WallWrench {
  std::int64_t dem_step = 0;
  bool commit = false;
  std::vector<BodyLoad> bodies;
  std::vector<double> channels;
};

enum class Action { hello = 1, state = 2, save = 3, load = 4, hash = 5, stop = 6 };

struct Command {
  Action action = Action::hello;
  std::string file;
};

struct Status {
  bool ok = true;
  std::string text;
};

using Body = std::variant<TargetMotion, WallWrench, Command, Status>;

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
