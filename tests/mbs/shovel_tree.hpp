// The shovel's bodies and joints as equations of motion, written out.
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/frames.hpp"
#include "machine/machine_data.hpp"
#include "mbs/shovel_joints.hpp"

namespace dipper::mbs {

/// Turns a vector up in the plane of the boom: x towards z.
struct Elevation {
  explicit Elevation(double angle);
  Vector3d operator*(const Vector3d& v) const {
    return {c * v.x() - s * v.z(), v.y(), s * v.x() + c * v.z()};
  }
  /// The other way.
  Vector3d undo(const Vector3d& v) const {
    return {c * v.x() + s * v.z(), v.y(), c * v.z() - s * v.x()};
  }
  double c, s;
};

/// Kane's equations of the chain house, sheaves, saddle block, handle with dipper, door: M u' = f.
///
/// All but the swing turns or slides in the plane of the boom. Written by hand, without Simbody, to
/// hold Simbody's answers to it.
///
/// Vectors are in H, which turns with the house: r from its origin, r' against it, so that in W the
/// velocity is r' + psi' z x r.
class ShovelTree {
 public:
  /// \param drum_inertia  kg m^2 that turns with the sheaves
  ShovelTree(const machine::MachineData& machine, const Pose& X_W0, double rake,
             double drum_inertia);

  /// Where the joints put the bodies, and how fast.
  struct Placement {
    Joints q, u;
    Elevation swing;  ///< of which sine and cosine are wanted only
    Elevation handle, dipper, door;
    struct Point {
      Vector3d r, rate;
    } dipper_origin, hinge, bail;  ///< the bail: the middle between its pins
    Vector3d gravity;              ///< m/s^2
  };
  Placement place(const Joints& q, const Joints& u) const;

  struct Equations {
    Eigen::Matrix<double, kJoints, kJoints> mass;
    Joints force;           ///< of rock, ropes, gravity, and of what turns
    double rock_power = 0;  ///< W
    double potential = 0;   ///< J of gravity, 0 at W's origin
  };
  /// \param pull  N, of both ropes together on the bail
  Equations equations(const Placement& at, const Wrenches& rock, const Vector3d& pull) const;

  std::array<BodyState, kBodies> bodies(const Placement& at) const;

 private:
  struct Part {
    double mass;
    Vector3d center;          ///< m, in its own axes, from the point it turns about
    Eigen::Matrix3d inertia;  ///< kg m^2 about its mass centre, in its own axes
  };
  /// One whose inertia is the same about every axis, and which only swings: m from the swing axis.
  struct RoundPart {
    double mass, inertia;
    Vector3d center;
  };
  struct Column;
  struct Moving;
  template <std::size_t N>
  static void add(const Part& part, const Moving& moving, const std::array<Column, N>& columns,
                  const Placement& at, Equations& e);
  static void add(const RoundPart& part, const Placement& at, Equations& e);
  template <std::size_t N>
  void load(const Wrench& F_W, const Placement::Point& point, double pitch_rate,
            const std::array<Column, N>& columns, const Placement& at, Equations& e) const;
  Vector3d to_house(const Vector3d& v_W, const Elevation& swing) const;

  Pose X_W0_;
  double rake_, reach_;
  Vector3d saddle_;
  Vector3d end_to_dipper_, end_to_hinge_, end_to_bail_;  ///< m, in A, from the handle's end
  Part tool_;                                            ///< handle and dipper, axes of A
  Part door_;
  RoundPart house_, sheaves_, block_;
  double total_mass_;
};

}  // namespace dipper::mbs
