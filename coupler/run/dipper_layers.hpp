// Liners and stuck rock on the inside of the dipper: less room, more mass.
#pragma once

#include <optional>

#include "coupler/case/case.hpp"
#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper {

/// What the case's layers add up to.
struct DipperLayers {
  std::optional<TriangleMesh> mesh;  ///< the dipper with its layers; none: as in its file
  double mass_kg = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< in B
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about center_m
};

/// machine.liner_thickness_m of steel on floor, roof and sides, under machine.carry_back_m of rock
/// at its bulk density on the floor. `cavity` in B. Throws std::invalid_argument naming the key.
DipperLayers dipper_layers(const Case& c, const BoundingBox& cavity);

}  // namespace dipper
