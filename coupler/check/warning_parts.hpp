// The parts of warnings(), and their input. Internal to it.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"
#include "coupler/check/dug_motion.hpp"
#include "machine/kinematics.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"

namespace dipper::check {

/// A sound case with what its files hold.
struct CaseParts {
  explicit CaseParts(const cases::Case& c);
  CaseParts(const CaseParts&) = delete;  // `motion` points into it
  bool planned() const { return c.machine.operated_by == cases::OperatorKind::plan; }

  const cases::Case& c;
  machine::MachineData machine;
  DugMotion dug;
  const machine::Motion& motion;
  machine::ShovelKinematics shovel;
  mesh::TriangleMesh dipper, door;  ///< the door is empty when the case has none
  mesh::TriangleMesh truck;         ///< in W
};

/// The warnings of a shovel's case (warnings.hpp).
std::vector<Finding> warnings(const CaseParts& parts);

/// A sieve curve that says nothing of the coarsest rock, is cut short by more than half of its
/// mass, or may have a share of 1.
void warn_of_sieve(const cases::Case& c, std::vector<Finding>& warnings);

/// A pile.profile whose face is steeper than rock rests, that begins with a step, or has one point
/// far over or under its neighbours; a crust above all rock.
void warn_of_bench(const cases::Case& c, std::vector<Finding>& warnings);

/// A table of poses (machine.kind poses) that is legal and hardly meant: times in ms, or that do
/// not begin at 0; speeds that no tool has; the scalar of its quaternions last.
void warn_of_poses(const cases::Case& c, std::vector<Finding>& warnings);

/// Bodies of such a table that never move, go under the ground, or whose cavity is beyond their
/// mesh.
void warn_of_pose_bodies(const cases::Case& c, std::vector<Finding>& warnings);

/// Positions: machine and truck against the bench at the start, the dipper's path against the
/// truck, the truck against the dump, the return against the next dig, the heel against the path of
/// the teeth.
void warn_of_places(const CaseParts& parts, std::vector<Finding>& warnings);

/// An operator who finds no dig; passes whose teeth sweep too little of the bench to fill the
/// dipper.
void warn_of_sweep(const CaseParts& parts, std::vector<Finding>& warnings);

/// A body's cavity that is beyond its mesh, each in the body's frame.
void warn_of_cavity(const cases::Case& c, const std::string& body, const Box& mesh,
                    const Box& cavity, std::vector<Finding>& warnings);

/// The volume of the mesh against its YAML and the machine; only for a mesh without other faults.
void warn_of_volume(const CaseParts& parts, std::vector<Finding>& warnings);

/// Numbers that look as if in another unit, or that do not fit the machine, mesh or pile.
void warn_of_numbers(const CaseParts& parts, std::vector<Finding>& warnings);

/// The machine's file, rake and the truck's heading, where they look as if in another unit, a
/// handle with its mass outside it, and ropes that do not hold the dipper.
void warn_of_machine(const CaseParts& parts, std::vector<Finding>& warnings);

}  // namespace dipper::check
