// The shovel in Simbody: bodies, joints, forces and integrator (Svanberg et al. 2021, Table 3).
#pragma once

#include <Simbody.h>

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>

#include "common/frames.hpp"
#include "machine/machine_data.hpp"
#include "machine/motion.hpp"
#include "mbs/shovel_joints.hpp"
#include "mbs/shovel_loads.hpp"

namespace dipper::mbs {

/// The integrated state: joints, works, and the nodes of segmented ropes.
struct ShovelNumbers {
  Joints q = Joints::Zero();                        ///< joint coordinates, m and rad
  Joints u = Joints::Zero();                        ///< joint speeds, m/s and rad/s
  Eigen::Vector3d works = Eigen::Vector3d::Zero();  ///< J: by the drives, by the rock, dissipated
  Eigen::VectorXd rope;                             ///< of one side; empty: elastic ropes
};

/// The shovel at an instant, realized by Simbody.
struct ShovelInstant {
  Joints acceleration;
  Joints reaction;  ///< N m and N, what it takes to move the prescribed joints; 0 of free ones
  ShovelLoads loads;
  DriveReport drives;
  double rock_power;          ///< W
  double potential, kinetic;  ///< J, the potential 0 at W's origin
};

/// One object, built once, not copied: Simbody's handles point into each other.
///
///   crawlers (ground) - swing, hinge about z - house
///   house - boom top, hinge about y, turned by the rigid upper rope - sheaves
///   house - saddle, hinge about -y, free - saddle block
///   saddle block - crowd, slider along x - handle with dipper (frame B)
///   dipper - hinge about y, prescribed - door (frame D)
///
/// Prescribed drives are motions in Simbody. All else are forces: gravity, the rock's wrenches, and
/// the laws of shovel_loads.hpp.
class ShovelSystem {
 public:
  /// The drives' set points at a time, s.
  using SetPoint = std::function<machine::DriveState(double)>;

  /// \param longest_step_s  of the integrator, unless the ropes need a shorter one
  ShovelSystem(const machine::MachineData& machine, machine::DriveMode mode, const Pose& X_W0,
               double rake, double longest_step_s, SetPoint set_point);
  ~ShovelSystem();
  ShovelSystem(const ShovelSystem&) = delete;
  ShovelSystem& operator=(const ShovelSystem&) = delete;

  /// Finds the saddle angle near `saddle` at which the stretched ropes carry the weight while the
  /// drives are at rest at a position; limited drives hold the machine there from then on. Throws
  /// std::runtime_error when there is no such angle.
  ShovelNumbers find_equilibrium(const machine::Drives& position, double saddle);

  /// Sets its state, without rock on it.
  void set(double t_s, const ShovelNumbers& numbers);

  /// Sets the rock's wrenches from now on.
  void hold(const Wrenches& rock);

  /// Call when the set points after the present time have changed.
  void set_points_changed();

  /// Integrates to a time with Simbody's Runge-Kutta 3, in the fewest equal steps within the
  /// longest step. A jump of the prescribed accelerations at the end belongs to the next interval.
  void step_to(double t_s);

  ShovelNumbers numbers() const;

  /// The forces at the present state, without accelerations.
  const ShovelLoads& loads();

  /// Realizes accelerations. Throws std::domain_error where the ropes have no path.
  ShovelInstant instant();

  /// Poses and twists of dipper and door.
  std::array<BodyState, kBodies> bodies();

  /// The bodies' poses h seconds from now: prescribed joints by their set points, the others with
  /// their present accelerations (call `instant` first).
  std::array<Pose, kBodies> poses_in(double h);

  const ShovelLoadLaws& laws() const { return laws_; }

 private:
  struct Forces;
  struct DriveMotion;
  class Target;
  SimTK::State& state() { return integrator_->updAdvancedState(); }
  ShovelPlace place(const SimTK::State& state) const;
  Joints reaction(const SimTK::State& state) const;
  double rock_power(const SimTK::State& state) const;
  void prescribe(SimTK::MobilizedBody& body, double machine::Drives::*drive, double scale);

  ShovelLoadLaws laws_;
  std::unique_ptr<Target> target_;
  Vector3d bail_B_;
  double longest_step_s_;
  bool held_ = false;  ///< joints are locked, and motors with limits give nothing
  Wrenches rock_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::Gravity gravity_;
  SimTK::Force::DiscreteForces rock_forces_;
  SimTK::MobilizedBody house_, sheaves_, saddle_, dipper_, door_;
  Forces* loads_ = nullptr;  ///< owned by forces_
  std::unique_ptr<SimTK::Integrator> integrator_;
  SimTK::State blank_;  ///< as Simbody makes it
  SimTK::State ahead_;  ///< for poses_in
  mutable SimTK::Vector scratch_;
};

}  // namespace dipper::mbs
