// Meshes with known mass properties.
#pragma once

#include <cmath>

#include "coupler/deck/triangle_mesh.hpp"

namespace dipper {

inline TriangleMesh box_mesh(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  const auto corner = [&](int i) {
    return Eigen::Vector3d((i & 1) != 0 ? hi.x() : lo.x(), (i & 2) != 0 ? hi.y() : lo.y(),
                           (i & 4) != 0 ? hi.z() : lo.z());
  };
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  TriangleMesh mesh;
  for (const auto& f : kFaces) {
    mesh.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    mesh.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return mesh;
}

/// n rings of 2n facets between the poles, corners on the sphere.
inline TriangleMesh sphere_mesh(double r, int n) {
  const auto at = [&](int i, int j) {
    const double a = M_PI * i / n, b = M_PI * (j % (2 * n)) / n;
    if (i == 0 || i == n) return Eigen::Vector3d(0, 0, i == 0 ? r : -r);
    return Eigen::Vector3d(r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b),
                           r * std::cos(a));
  };
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      if (i + 1 < n) mesh.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

}  // namespace dipper
