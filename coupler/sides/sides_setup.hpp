// From a case to the input of each side.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/mesh_facts.hpp"
#include "coupler/setup/machine_setup.hpp"
#include "coupler/setup/rock_setup.hpp"
#include "coupler/sides/dipper_layers.hpp"

namespace dipper::sides {

/// Contents of the YAML files beside the meshes.
struct MeshFacts {
  cases::DipperFacts dipper;         ///< only of a shovel
  std::map<std::string, Box> loads;  ///< body -> box in its frame in which rock is weighed
  std::optional<Box> truck_bed;      ///< in T; none without a truck
};

/// Reads them. Throws std::runtime_error with the first finding; a checked case has none.
MeshFacts read_mesh_facts(const cases::Case& c);

/// The input of dipper-dem. `resumed`: the state of the walls, when `restart` is a checkpoint and
/// not a settled pile.
setup::RockSetup rock_setup(const cases::Case& c, const MeshFacts& facts,
                            const std::filesystem::path& deck, const std::filesystem::path& dumps,
                            const std::filesystem::path& logs, const std::filesystem::path& restart,
                            const std::optional<std::vector<setup::WallMemory>>& resumed);

/// The input of dipper-mbs. `program_drives`: a program drives (coupler/operate).
setup::MachineSetup machine_setup(const cases::Case& c, const DipperLayers& layers,
                                  bool program_drives = false);

}  // namespace dipper::sides
