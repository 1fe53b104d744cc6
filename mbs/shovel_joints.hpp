// The shovel's joints, and the bodies in contact with rock.
#pragma once

#include <Eigen/Core>
#include <array>

#include "common/frames.hpp"

namespace dipper::mbs {

/// In the order of Simbody's mobilities (shovel_system.hpp).
enum Joint { kSwing, kSheaves, kSaddle, kCrowd, kDoor, kJoints };
using Joints = Eigen::Matrix<double, kJoints, 1>;  ///< rad and m, or their rates, or N m and N

constexpr std::size_t kBodies = 2;             ///< in contact with rock: dipper, door
using Wrenches = std::array<Wrench, kBodies>;  ///< of the rock on them: F_Bo_W, F_Do_W

}  // namespace dipper::mbs
