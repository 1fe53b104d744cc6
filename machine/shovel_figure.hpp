// Shapes of a shovel for pictures, made from the machine's data. They are not in contact with rock.
#pragma once

#include <string>
#include <vector>

#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"
#include "machine/machine_data.hpp"

namespace dipper::machine {

struct FigurePart {
  std::string name;         ///< such as "boom"; also selects the colour
  mesh::TriangleMesh mesh;  ///< closed, in the frame that it moves with
};

/// The parts by the body that they move with. The dipper's walls and its door are meshes of the
/// case; here are only the parts that hold them.
struct ShovelFigure {
  std::vector<FigurePart> ground;  ///< crawlers, in H at swing 0
  std::vector<FigurePart> house;   ///< in H: house, boom, sheaves
  std::vector<FigurePart> saddle;  ///< in A
  std::vector<FigurePart> handle;  ///< in E: axes of A, at the handle's dipper end
  std::vector<FigurePart> dipper;  ///< in B: the handle's lugs, the bail
  double rope_radius;              ///< m
};

/// Boom point, sheaves, saddle, handle, bail and winch are placed by the data. Other parts (house,
/// crawlers, plates) are drawn in the proportions of a rope shovel, by the winch's height and the
/// boom's length. Throws std::invalid_argument when the data do not allow that: no winch above
/// ground, no boom.
ShovelFigure shovel_figure(const MachineData& machine);

/// A hoist rope's path in H, from the winch over its sheave to the bail pin at `p_HL` [m], always
/// drawn taut. `side` is 1 for the left rope, -1 for the right one. Throws as
/// sheave_path does.
std::vector<Vector3d> rope_way(const MachineData& machine, double side, const Vector3d& p_HL);

}  // namespace dipper::machine
