// plan.yaml: the plan from which a case's motion.csv is made.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "machine/motion_plan.hpp"
#include "machine/pass_choice.hpp"

namespace dipper::machine {

/// The surface in the plane of the boom at a heading [rad], x from the swing axis; `name` is
/// that of the plan: "pile", or a path as in the file.
using FaceNamed = std::function<TeethPath(const std::string& name, double heading_rad)>;

struct PlanFile {
  std::string source;  ///< the source of the curves, for the head of motion.csv
  MotionPlan plan;
  std::optional<DigChoice> choice;  ///< in place of the plan's passes: an operator chooses them
};

/// Reads a plan (docs/motion.md has its keys) and computes its cuts through the faces. Throws
/// InputError with every fault and its line, those of `face` included.
PlanFile read_plan(const std::filesystem::path& file, const MachineData& machine,
                   const ShovelKinematics& shovel, const FaceNamed& face);

}  // namespace dipper::machine
