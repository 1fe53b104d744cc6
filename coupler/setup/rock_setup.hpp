// What dipper-dem is started with: the launcher writes it, LiggghtsRock reads it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/box.hpp"
#include "common/frames.hpp"

namespace dipper::setup {

/// What a wall remembers of its last step, beyond what LIGGGHTS's restart file holds.
struct WallMemory {
  Wrench load;
  Twist V_WB_W;
};

/// A box that rock is weighed in: fixed to a body, or to the world.
struct Scale {
  std::string name;  ///< the channel, in kg
  std::string body;  ///< "" for a fixed box
  Pose X_WS;         ///< the fixed box's frame; unused with a body
  Box box;           ///< in the body's frame, or in S
};

/// When rock at rest is held (dem/hold_policy.hpp).
struct HoldSettings {
  double below_m_s = 0.01;  ///< centre slower than this, from look to look ...
  double rest_s = 0.2;      ///< ... for this long: at rest
  double unbalance = 2.0;   ///< change of a held rock's load, of its weight, that wakes it
  double average_s =
      0.1;                ///< over which the load is averaged: rock chatters, and impacts are short
  double margin_m = 1.0;  ///< no rock rests nearer to a moving wall than this
  double ahead_s = 0.5;   ///< nor to where the wall will be within this time
  double check_s = 0.01;  ///< between looks at what must wake at once
  double gather_s = 0.1;  ///< between looks at who may rest, and who is disturbed
  double layer_m = 0.5;   ///< of held rock between moving and parked rock (the paper's)
  double sight_s = 0.1;   ///< and on the moving rock's way over this time
};

/// Where rock is bonded when a run begins (not when it is resumed).
struct CrustZone {
  double above_m = 0;      ///< height in W
  double thickness_m = 0;  ///< straight down from the surface; 0: no limit
};

/// Rock that comes into the run.
struct RockFall {
  std::string deck;          ///< LIGGGHTS commands that let it in with the next step
  std::int64_t at_step = 0;  ///< in the window that begins at this step or holds it
  double mass_kg = 0;        ///< of it, about
};

/// Where rock is held fixed from the start of a run on, until a moving wall comes near: rock whose
/// centre is within the depth of the ground, the rear wall or a side wall. The layer of the paper's
/// simplified model (Svanberg et al. 2021, section 3.2 and Fig. 11b), 0.5 m there.
struct HeldLayer {
  double depth_m = 0;
  double rear_x_m = 0, half_width_m = 0;  ///< of the pile, in W
};

/// The floor in front of the face, which is cleared after each pause: x < to_x, |y| < half_width,
/// z < height, in W.
struct FloorStrip {
  double to_x_m = 0, half_width_m = 0, height_m = 0;
};

/// What dipper-dem is started with (written by the launcher as JSON).
struct RockSetup {
  int ranks = 1;          ///< of MPI
  bool fast_loop = true;  ///< the loop of dem/fast; false: LIGGGHTS's own
  std::string deck;       ///< LIGGGHTS input script
  std::vector<std::pair<std::string, std::string>> variables;  ///< -var NAME VALUE
  std::string log;                                             ///< LIGGGHTS log file
  std::string screen;                                          ///< LIGGGHTS screen output
  std::vector<std::string> bodies;                             ///< fix ids of the moving walls
  std::vector<Scale> scales;
  std::vector<std::string> cleared;  ///< fix ids of the walls that no rock may overlap at the start
  std::optional<CrustZone> crust;
  std::optional<RockFall> fall;
  std::optional<HeldLayer> layer;
  bool pauses = false;               ///< the bodies' contact can be told to pause
  std::optional<FloorStrip> floor;   ///< needs pauses
  std::optional<HoldSettings> hold;  ///< not set: all rock is computed all the time
  /// Set, one a body, when the deck reads a checkpoint, with the walls in place.
  std::optional<std::vector<WallMemory>> resumed;
  std::string image;  ///< then: the image beside the checkpoint (image_of); "": there is none
};

/// The file that a checkpoint's restart file of LIGGGHTS goes with: rock that LIGGGHTS's own file
/// has only roughly, to the bit.
inline std::string image_of(const std::filesystem::path& restart) {
  return restart.string() + ".image";
}

/// As JSON, and back.
nlohmann::json to_json(const RockSetup& setup);
RockSetup rock_setup_from(const nlohmann::json& j);

}  // namespace dipper::setup
