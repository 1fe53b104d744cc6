// The dipper in use: liners and carry-back inside it, worn teeth.
#pragma once

#include <optional>

#include "common/mesh/triangle_mesh.hpp"
#include "coupler/case/case.hpp"

namespace dipper::sides {

/// The combined change by the case's layers and wear.
struct DipperLayers {
  std::optional<mesh::TriangleMesh> mesh;  ///< with worn teeth; none: unchanged
  double mass_kg = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();       ///< in B
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  ///< about center_m
};

/// Steel of machine.liner_thickness_m on floor, roof and sides; under it machine.carry_back_m of
/// rock at bulk density on the floor; teeth shortened by machine.tooth_wear_m, whose mass stays
/// (six teeth lose 0.4 t in 0.4 m, of a dipper of 42 t). `cavity` in B. Throws
/// std::invalid_argument naming the key.
DipperLayers dipper_layers(const cases::Case& c, const Box& cavity);

}  // namespace dipper::sides
