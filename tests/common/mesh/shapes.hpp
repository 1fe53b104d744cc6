// Meshes with known mass properties, and their STL files.
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "common/mesh/triangle_mesh.hpp"

namespace dipper::test {

/// A closed box from `low` to `high` [m]: 12 facets, facing outwards. Facets 1 and 2 are the floor.
inline mesh::TriangleMesh box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  mesh::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                               i & 4 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// n rings of 2n facets between the poles, corners on the sphere of radius r [m] about the origin.
inline mesh::TriangleMesh sphere(double r, int n) {
  mesh::TriangleMesh mesh;
  const auto ring = 2 * static_cast<std::size_t>(n), south = ring * (ring / 2 - 1) + 1;
  mesh.vertices.emplace_back(0, 0, r);
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < 2 * n; ++j) {
      const double a = M_PI * i / n, b = M_PI * j / n;
      mesh.vertices.emplace_back(r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b),
                                 r * std::cos(a));
    }
  mesh.vertices.emplace_back(0, 0, -r);
  const auto at = [&](std::size_t i, std::size_t j) {
    if (i == 0) return std::size_t{0};
    return 2 * i == ring ? south : 1 + (i - 1) * ring + j % ring;
  };
  for (std::size_t i = 0; 2 * i < ring; ++i)
    for (std::size_t j = 0; j < ring; ++j) {
      if (2 * (i + 1) < ring) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// 7 lines a facet after the first; facet N's vertices are in lines 7 N - 3 to 7 N - 1.
inline std::string ascii_stl(const mesh::TriangleMesh& mesh) {
  std::string text = "solid box of a test\n";
  for (const auto& t : mesh.triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::size_t i : t) {
      const auto& v = mesh.vertices[i];
      text += fmt::format("      vertex {} {} {}\n", v.x(), v.y(), v.z());
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid\n";
}

inline std::string binary_stl(const mesh::TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(0.0f);
    for (const std::size_t i : t) {
      for (int k = 0; k < 3; ++k) put(static_cast<float>(mesh.vertices[i][k]));
    }
    put(std::uint16_t{0});
  }
  return bytes;
}

}  // namespace dipper::test
