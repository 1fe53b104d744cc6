// The parts of check_case, one a subject. Internal to it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"
#include "machine/kinematics.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

using Findings = std::vector<Finding>;

/// False, and a finding, when the file of a key does not exist.
bool file_exists(const cases::Case& c, const std::string& key, const std::filesystem::path& file,
                 Findings& findings);

/// Reads the STL of a key and reports every fault. Empty when the file cannot be read.
std::optional<mesh::TriangleMesh> load_sound_mesh(const cases::Case& c, const std::string& key,
                                                  const std::filesystem::path& file,
                                                  Findings& findings);

/// False, and a finding, when a mesh is longer than the domain, in another unit, or lies farther
/// from its origin, in a mine's coordinates. Further findings about it would add nothing.
bool check_unit(const cases::Case& c, const std::string& key, const mesh::TriangleMesh& mesh,
                Findings& findings);

/// The bed in the YAML file beside the truck's mesh, against the mesh.
void check_bed(const cases::Case& c, const mesh::TriangleMesh& truck, Findings& findings);

/// The YAML files beside the dipper's and the truck's mesh: read, and a cavity that encloses the
/// struck volume, under a heap that is not far higher than it is deep.
void check_mesh_facts(const cases::Case& c, Findings& findings);

/// Teeth long enough for machine.tooth_wear_m.
void check_tooth_wear(const cases::Case& c, const mesh::TriangleMesh& dipper, Findings& findings);

/// The truck's mesh where it stands, in W.
mesh::TriangleMesh placed_truck(const cases::Case& c, mesh::TriangleMesh truck);

/// Truck and pile inside the domain.
void check_truck_in_domain(const cases::Case& c, const mesh::TriangleMesh& truck,
                           Findings& findings);
void check_pile_in_domain(const cases::Case& c, Findings& findings);

/// Motion and machine: readable, within limits, and the bodies' meshes inside the domain all the
/// time. Empty when the motion cannot be read.
std::optional<machine::Motion> check_motion(const cases::Case& c,
                                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                                            Findings& findings);

/// The slab of collapse.height_m: a rock of it at least, inside the domain, during the motion, and
/// not where the bodies are at that time.
void check_collapse(const cases::Case& c, const machine::ShovelKinematics& shovel,
                    const machine::Motion& motion,
                    const std::map<std::string, mesh::TriangleMesh>& bodies, Findings& findings);

/// machine.kind poses: a readable table with every body and no other, and the bodies' meshes inside
/// the domain all the time.
void check_poses(const cases::Case& c, const std::map<std::string, mesh::TriangleMesh>& bodies,
                 Findings& findings);

/// The bodies' meshes inside the domain from start to end. `pose_at`: of a body at a time [ns];
/// nothing where there is none.
using PoseAt = std::function<std::optional<Pose>(const std::string& body, std::int64_t t_ns)>;
void check_bodies_in_domain(const cases::Case& c, const PoseAt& pose_at, std::int64_t start_ns,
                            std::int64_t end_ns,
                            const std::map<std::string, mesh::TriangleMesh>& bodies,
                            Findings& findings);

/// Windows against the simulated time, of a motion until end.
void check_windows(const cases::Case& c, std::int64_t end_ns, Findings& findings);

/// Shapes that exist, a rock at least in every class, a stable DEM step.
void check_rock(const cases::Case& c, Findings& findings);

/// The case with one shape in classes that mix spheres and others, which check_rock reports: the
/// other checks of the rock can then run.
cases::Case without_mixed_classes(cases::Case c);

}  // namespace dipper::check
