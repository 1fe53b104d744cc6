#include "coupler/sides/dipper_layers.hpp"

#include <stdexcept>
#include <vector>

#include "common/mesh/lining.hpp"
#include "common/mesh/stl.hpp"
#include "common/mesh/tooth_wear.hpp"

namespace dipper::sides {
namespace {

constexpr double kSteel_kg_m3 = 7850;  // wear plate; EN 1991-1-1, Table A.4: 77-78.5 kN/m3

struct Layer {
  const char* key;
  double thickness_m;
  double density_kg_m3;
  mesh::LinedFaces faces;
};

/// One layer's mass properties, about its own centre.
struct LayerMass {
  double mass_kg;
  Eigen::Vector3d center_m;
  Eigen::Matrix3d inertia_kg_m2;
};

}  // namespace

DipperLayers dipper_layers(const cases::Case& c, const Box& cavity) {
  DipperLayers sum;
  mesh::TriangleMesh mesh;
  std::vector<LayerMass> parts;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Layer& layer : {Layer{"machine.liner_thickness_m", c.machine.liner_thickness_m,
                                   kSteel_kg_m3, mesh::LinedFaces::all_sides},
                             Layer{"machine.carry_back_m", c.machine.carry_back_m,
                                   c.rock.bulk_density_kg_m3, mesh::LinedFaces::floor}}) {
    if (layer.thickness_m == 0) continue;
    if (!sum.mesh) sum.mesh = mesh::read_stl(c.bodies.at("dipper"));
    try {
      mesh::Lining lined = mesh::line_dipper(*sum.mesh, cavity, layer.thickness_m, layer.faces);
      sum.mesh = std::move(lined.mesh);
      const mesh::MassProperties& solid = lined.layer;
      parts.push_back({solid.volume_m3 * layer.density_kg_m3, solid.com_m,
                       solid.inertia_m5 * layer.density_kg_m3});
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(std::string(layer.key) + ": " + e.what());
    }
    sum.mass_kg += parts.back().mass_kg;
    moment += parts.back().mass_kg * parts.back().center_m;
  }
  if (c.machine.tooth_wear_m > 0) {
    if (!sum.mesh) sum.mesh = mesh::read_stl(c.bodies.at("dipper"));
    try {
      sum.mesh = mesh::wear_teeth(*sum.mesh, c.machine.tooth_wear_m);
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument(std::string("machine.tooth_wear_m: ") + e.what());
    }
  }
  if (sum.mass_kg > 0) sum.center_m = moment / sum.mass_kg;
  for (const LayerMass& m : parts) {
    const Eigen::Vector3d d = m.center_m - sum.center_m;
    sum.inertia_kg_m2 +=
        m.inertia_kg_m2 +
        m.mass_kg * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
  }
  return sum;
}

}  // namespace dipper::sides
