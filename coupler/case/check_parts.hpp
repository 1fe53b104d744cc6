// The parts of check_case, one a subject. Internal to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/mesh/triangle_mesh.hpp"
#include "coupler/motion/kinematics.hpp"
#include "coupler/motion/motion.hpp"

namespace dipper::check {

using Findings = std::vector<Finding>;

/// False, and a finding, when the file of a key does not exist.
bool file_exists(const Case& c, const std::string& key, const std::filesystem::path& file,
                 Findings& findings);

/// Reads the STL of a key and reports every fault. Empty when the file cannot be read.
std::optional<TriangleMesh> load_sound_mesh(const Case& c, const std::string& key,
                                            const std::filesystem::path& file, Findings& findings);

/// The YAML files beside the dipper's and the truck's mesh.
void check_mesh_facts(const Case& c, Findings& findings);

/// Teeth long enough for machine.tooth_wear_m.
void check_tooth_wear(const Case& c, const TriangleMesh& dipper, Findings& findings);

/// Truck and pile inside the domain.
void check_truck_in_domain(const Case& c, const TriangleMesh& truck, Findings& findings);
void check_pile_in_domain(const Case& c, Findings& findings);

/// Motion and machine: readable, within limits, and the bodies' meshes inside the domain all the
/// time. Empty when the motion cannot be read.
std::optional<Motion> check_motion(const Case& c, const std::map<std::string, TriangleMesh>& bodies,
                                   Findings& findings);

/// The slab of collapse.height_m: a rock of it at least, inside the domain, during the motion, and
/// not where the bodies are just then.
void check_collapse(const Case& c, const ShovelKinematics& shovel, const Motion& motion,
                    const std::map<std::string, TriangleMesh>& bodies, Findings& findings);

/// Windows against the simulated time.
void check_windows(const Case& c, const Motion& motion, Findings& findings);

/// Shapes that exist, a rock at least in every class, a stable DEM step.
void check_rock(const Case& c, Findings& findings);

}  // namespace dipper::check
