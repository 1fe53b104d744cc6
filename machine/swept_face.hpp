// The part of a face that the teeth sweep, by geometry alone.
#pragma once

#include <functional>
#include <vector>

#include "machine/kinematics.hpp"
#include "machine/teeth_path.hpp"

namespace dipper::machine {

struct SweptPass {
  double t_start_s = 0;  ///< of the dig
  double area_m2 = 0;    ///< between the face and the path of the teeth, in the plane of the boom
  double deepest_m = 0;  ///< of the cut, straight up from the teeth
  bool first = true;     ///< the first in its lane
};

/// One entry a dig: from the motion's start and the end of each return on, until the door opens or
/// the boom turns away. A later dig at about the same heading meets the face that earlier ones
/// left, as if no rock came down: the least it can meet. \param face  at a heading [rad], x from
/// the swing axis
std::vector<SweptPass> swept_passes(const Motion& motion, const ShovelKinematics& shovel,
                                    const std::function<TeethPath(double heading_rad)>& face);

}  // namespace dipper::machine
