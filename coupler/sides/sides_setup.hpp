// From a case to what each side is started with.
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

/// What the YAML files beside the meshes say.
struct MeshFacts {
  cases::DipperFacts dipper;         ///< of a shovel
  std::map<std::string, Box> loads;  ///< body -> where rock in it is weighed, in its frame
  std::optional<Box> truck_bed;      ///< in T; none: no truck
};

/// Reads them. Throws std::runtime_error with the first finding, of which a checked case has none.
MeshFacts read_mesh_facts(const cases::Case& c);

/// What dipper-dem is started with. `resumed`: when `restart` is a checkpoint and not a settled
/// pile, what the walls remember.
setup::RockSetup rock_setup(const cases::Case& c, const MeshFacts& facts,
                            const std::filesystem::path& deck, const std::filesystem::path& dumps,
                            const std::filesystem::path& logs, const std::filesystem::path& restart,
                            const std::optional<std::vector<setup::WallMemory>>& resumed);

/// What dipper-mbs is started with. `told`: a program drives (coupler/operate).
setup::MachineSetup machine_setup(const cases::Case& c, const DipperLayers& layers,
                                  bool told = false);

}  // namespace dipper::sides
