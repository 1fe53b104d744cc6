// The input of dipper-mbs: written by the launcher, read by the machine's process.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "common/frames.hpp"
#include "machine/machine_condition.hpp"
#include "machine/machine_data.hpp"

namespace dipper::setup {

/// A shovel that follows a motion or a program's orders.
struct ShovelSetup {
  std::filesystem::path model;   ///< dimensions and masses, YAML
  std::filesystem::path motion;  ///< CSV
  bool planned = false;          ///< stands at the motion's start until it is sent more rows
  double full_kg = 0;  ///< planned only: the load that its operator regards as a full dipper
  machine::DriveMode drives = machine::DriveMode::prescribed;
  bool program_drives =
      false;  ///< limited drives follow the orders of each window, from the motion's start
  bool contact_on_return = true;
  Vector3d base_position_m = Vector3d::Zero();  ///< swing axis at ground level, in W
  double rake_angle_deg = 0;
  machine::MachineCondition condition;
};

/// Bodies that follow a table of poses.
struct PosesSetup {
  std::filesystem::path table;      ///< CSV
  std::vector<std::string> bodies;  ///< in the order of the launcher's bodies
};

using MachineSetup = std::variant<ShovelSetup, PosesSetup>;

/// As JSON, and back. Throws nlohmann::json::exception for a missing key.
nlohmann::json to_json(const MachineSetup& setup);
MachineSetup machine_setup_from(const nlohmann::json& j);

}  // namespace dipper::setup
