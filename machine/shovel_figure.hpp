// What a shovel looks like: shapes for pictures, made from the machine's data. The rock never meets
// them.
#pragma once

#include <string>
#include <vector>

#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"
#include "machine/machine_data.hpp"

namespace dipper::machine {

struct FigurePart {
  std::string name;         ///< "boom": what it is, and which colour it gets
  mesh::TriangleMesh mesh;  ///< closed, in the frame that it moves with
};

/// The parts by what they move with. The dipper's walls and its door are meshes of the case: here
/// is only what holds them.
struct ShovelFigure {
  std::vector<FigurePart> ground;  ///< crawlers, in H at swing 0
  std::vector<FigurePart> house;   ///< in H: house, boom, sheaves
  std::vector<FigurePart> saddle;  ///< in A
  std::vector<FigurePart> handle;  ///< in E: axes of A, at the handle's dipper end
  std::vector<FigurePart> dipper;  ///< in B: the handle's lugs, the bail
  double rope_radius;              ///< m
};

/// Boom point, sheaves, saddle, handle, bail and winch are where the data has them. What the data
/// does not have (house, crawlers, plates) is drawn in the proportions of a rope shovel, by the
/// winch's height and the boom's length. Throws std::invalid_argument when the data leave no room
/// for that: no winch above ground, no boom.
ShovelFigure shovel_figure(const MachineData& machine);

/// A hoist rope's way in H, from the winch over its sheave to the bail pin at `p_HL` [m]: taut,
/// whatever the drives do. `side` is 1 for the left rope, -1 for the right one. Throws as
/// sheave_path does.
std::vector<Vector3d> rope_way(const MachineData& machine, double side, const Vector3d& p_HL);

}  // namespace dipper::machine
