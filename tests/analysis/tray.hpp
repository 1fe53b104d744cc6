// A small open box of plates: a dipper for the tests.
#pragma once

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis {

/// A box-shaped solid between two corners.
inline void add_block(mesh::TriangleMesh& mesh, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b) {
  const auto p = [&](int k) {
    return Eigen::Vector3d((k & 1) != 0 ? b.x() : a.x(), (k & 2) != 0 ? b.y() : a.y(),
                           (k & 4) != 0 ? b.z() : a.z());
  };
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.add_loose({p(f[0]), p(f[1]), p(f[2])});
    mesh.add_loose({p(f[0]), p(f[2]), p(f[3])});
  }
}

/// Five plates 4 cm thick around a cavity of 2 x 1 x 1.5 m (x from 0, y and z about 0) that opens
/// to +x. The plates lie side by side: every one is a closed shell of its own.
inline mesh::TriangleMesh tray() {
  mesh::TriangleMesh m;
  constexpr double t = 0.04;
  add_block(m, {-t, -0.5 - t, -0.75 - t}, {0, 0.5 + t, 0.75 + t});
  add_block(m, {0, -0.5 - t, -0.75}, {2, -0.5, 0.75});
  add_block(m, {0, 0.5, -0.75}, {2, 0.5 + t, 0.75});
  add_block(m, {0, -0.5 - t, -0.75 - t}, {2, 0.5 + t, -0.75});
  add_block(m, {0, -0.5 - t, 0.75}, {2, 0.5 + t, 0.75 + t});
  return m;
}

}  // namespace dipper::analysis
