// What is drawn of the machine besides its walls: shovel and truck, moved by the record.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/run/run_folder.hpp"
#include "machine/shovel_figure.hpp"

namespace dipper::analysis::run {

/// In a run's folder: the machine's data as it ran.
constexpr const char* kMachineFile = "machine.yaml";

/// Parts that move as one.
struct FigureBody {
  std::string name;
  std::vector<machine::FigurePart> parts;
  std::function<Pose(double time_s)> X_WF;
};

/// A rope as the line it lies on, as many points at every time.
struct FigureRope {
  double radius_m;
  std::function<std::vector<Vector3d>(double time_s)> way_W;
  int pass = 0;  ///< of a line that shows a pass's path; 0: a rope
};

struct Figure {
  std::vector<FigureBody> bodies;
  std::vector<FigureRope> ropes;
};

/// Of a run that kept its machine's file: the shovel, and the truck about its bed where the run has
/// one. Empty for other folders. Throws what the machine's and the record's readers throw.
Figure read_figure(const RunData& run);

}  // namespace dipper::analysis::run
