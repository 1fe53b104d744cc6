// The YAML files beside the meshes of dipper and truck: the regions of the load, and the volume.
#pragma once

#include <string>
#include <vector>

#include "common/box.hpp"
#include "coupler/case/case.hpp"

namespace dipper::cases {

/// Beside the dipper's mesh. Boxes in B [m].
struct DipperFacts {
  double struck_volume_m3 = 0;
  Box cavity;  ///< up to the lip and the roof
  Box load;    ///< the cavity and the heap in front of the lip
};

/// Reads struck_volume_m3, cavity {min_m, max_m} and heap_height_m from the YAML file of the
/// dipper's mesh's name; other keys are the user's notes. Missing and impossible ones are
/// appended to `findings`; the facts are usable only when none was. Expects the body `name`.
DipperFacts read_dipper_facts(const Case& c, std::vector<Finding>& findings,
                              const std::string& name = "dipper");

/// The bodies whose file is read: a shovel's dipper, which must have one; of bodies that follow
/// poses those that have one.
std::vector<std::string> weighed_bodies(const Case& c);

/// Reads bed {min_m, max_m}, in the truck's frame [m], from the YAML file of the truck's mesh's
/// name, likewise.
Box read_truck_bed(const Case& c, std::vector<Finding>& findings);

}  // namespace dipper::cases
