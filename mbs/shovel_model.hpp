// The shovel's bodies and joints in Simbody (Svanberg et al. 2021, Table 3).
#pragma once

#include <Simbody.h>

#include <vector>

#include "common/frames.hpp"
#include "machine/machine_data.hpp"
#include "mbs/shovel_tree.hpp"

namespace dipper::mbs {

/// One object, built once, not copied: Simbody's handles point into each other.
///
///   crawlers (ground) - swing, hinge about z, driven - house
///   house - boom top, hinge about y, turned by the rigid upper rope - sheaves
///   house - saddle, hinge about -y, free - saddle block
///   saddle block - crowd, slider along x, driven - handle
///   handle - weld - dipper (frame B)
///   dipper - hinge about y, prescribed - door (frame D)
///
/// Moved by nothing of its own: it takes a motion, and tells what the joints have to give for it.
class ShovelModel {
 public:
  /// \param drum_inertia  kg m^2 that turns with the sheaves
  ShovelModel(const machine::MachineData& machine, const Pose& X_W0, double rake,
              double drum_inertia);
  ShovelModel(const ShovelModel&) = delete;
  ShovelModel& operator=(const ShovelModel&) = delete;

  /// M u' less all forces, Simbody's inverse dynamics: N m and N that each joint gives, 0 of free
  /// ones if the accelerations are right.
  /// \param applied  N m and N, of what acts on the joints
  /// \param pull     N, in H, of both ropes together on the bail
  Joints reactions(const Joints& q, const Joints& u, const Joints& acceleration,
                   const Joints& applied, const Wrenches& rock, const Vector3d& pull);

 private:
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::MobilizedBody house_, sheaves_, saddle_, handle_, dipper_, door_;
  struct Weight {
    SimTK::MobilizedBody body;
    double mass;
    SimTK::Vec3 center;
  };
  std::vector<Weight> weights_;
  SimTK::Vec3 bail_;  ///< in B, the middle between its pins
  SimTK::State state_;
  // Kept from call to call, as Simbody wants them.
  SimTK::Vector accelerations_, applied_, residual_;
  SimTK::Vector_<SimTK::SpatialVec> forces_;
};

}  // namespace dipper::mbs
