// The input of dipper-dem: written by the launcher, read by LiggghtsRock.
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

/// The state of a wall's last step that LIGGGHTS's restart file does not hold.
struct WallMemory {
  Wrench load;
  Twist V_WB_W;
};

/// A box in which rock is weighed: fixed to a body, or to the world.
struct Scale {
  std::string name;  ///< the channel, in kg
  std::string body;  ///< "" for a fixed box
  Pose X_WS;         ///< the fixed box's frame; unused with a body
  Box box;           ///< in the body's frame, or in S
};

/// When rock at rest is held (dem/hold_policy.hpp).
struct HoldSettings {
  double below_m_s = 0.01;  ///< speed of the centre between two checks ...
  double rest_s = 0.2;      ///< ... for this long: at rest
  double unbalance = 2.0;   ///< change of its load, in its own weights, that wakes a held rock
  double average_s = 0.1;   ///< averaging time of that load: contacts jitter, and impacts are short
  double margin_m = 1.0;    ///< rock this near to a moving wall is not held
  double ahead_s = 0.5;     ///< nor near to where the wall will be within this time
  double check_s = 0.01;    ///< between checks of what must wake at once
  double gather_s = 0.1;    ///< between checks of what may rest, and of disturbed rock
  double layer_m = 0.5;     ///< thickness of held rock between moving and parked rock (the paper's)
  double sight_s = 0.1;     ///< plus the distance that moving rock covers in this time
};

/// Where rock is bonded at the start of a run (not of a resumed one).
struct CrustZone {
  double above_m = 0;      ///< height in W
  double thickness_m = 0;  ///< straight down from the surface; 0: no limit
};

/// Rock that is added during the run.
struct RockFall {
  std::string deck;          ///< LIGGGHTS commands that add it with the next step
  std::int64_t at_step = 0;  ///< added in the window that begins at this step or contains it
  double mass_kg = 0;        ///< approximate
};

/// Rock held fixed from the start of a run until a moving wall comes near: rock whose centre is
/// within the depth of the ground, the rear wall or a side wall. The layer of the paper's
/// simplified model (Svanberg et al. 2021, section 3.2 and Fig. 11b), 0.5 m there.
struct HeldLayer {
  double depth_m = 0;
  double rear_x_m = 0, half_width_m = 0;  ///< of the pile, in W
};

/// The floor in front of the face, cleared after each pause: x < to_x, |y| < half_width, z <
/// height, in W.
struct FloorStrip {
  double to_x_m = 0, half_width_m = 0, height_m = 0;
};

/// What dipper-dem is started with (written by the launcher as JSON).
struct RockSetup {
  int ranks = 1;          ///< MPI ranks
  bool fast_loop = true;  ///< the loop of dem/fast; false: LIGGGHTS's own
  std::string deck;       ///< LIGGGHTS input script
  std::vector<std::pair<std::string, std::string>> variables;  ///< -var NAME VALUE
  std::string log;                                             ///< LIGGGHTS log file
  std::string screen;                                          ///< LIGGGHTS screen output
  std::vector<std::string> bodies;                             ///< fix ids of the moving walls
  std::vector<Scale> scales;
  std::vector<std::string> cleared;  ///< fix ids of walls that rock may not overlap at the start
  std::optional<CrustZone> crust;
  std::optional<RockFall> fall;
  std::optional<HeldLayer> layer;
  bool pauses = false;               ///< contact with the bodies can be switched off
  std::optional<FloorStrip> floor;   ///< needs pauses
  std::optional<HoldSettings> hold;  ///< not set: all rock is computed all the time
  /// Set for each body when the deck reads a checkpoint, with the walls in place.
  std::optional<std::vector<WallMemory>> resumed;
  std::string image;  ///< if resumed: the image beside the checkpoint (image_of); "": none
};

/// The file that belongs to a checkpoint's LIGGGHTS restart file: exact state of the rock that the
/// restart file only has with rounding.
inline std::string image_of(const std::filesystem::path& restart) {
  return restart.string() + ".image";
}

/// As JSON, and back.
nlohmann::json to_json(const RockSetup& setup);
RockSetup rock_setup_from(const nlohmann::json& j);

}  // namespace dipper::setup
