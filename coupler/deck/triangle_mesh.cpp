#include "coupler/deck/triangle_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace dipper {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kBinaryHeader = 84;
constexpr std::size_t kBinaryFacet = 50;

TriangleMesh parse_binary(const std::string& bytes, std::uint32_t count) {
  TriangleMesh mesh(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<float, 12> f{};  // normal, then three corners
    std::memcpy(f.data(), bytes.data() + kBinaryHeader + i * kBinaryFacet, sizeof(f));
    for (std::size_t k = 0; k < 3; ++k)
      mesh[i][k] = Vector3d(f[3 + 3 * k], f[4 + 3 * k], f[5 + 3 * k]);
  }
  return mesh;
}

TriangleMesh parse_ascii(const std::string& text) {
  TriangleMesh mesh;
  std::istringstream in(text);
  std::string word;
  std::size_t corner = 0;
  while (in >> word) {
    if (word != "vertex") continue;
    Vector3d p;
    if (!(in >> p.x() >> p.y() >> p.z())) return {};
    if (corner == 0) mesh.emplace_back();
    mesh.back()[corner] = p;
    corner = (corner + 1) % 3;
  }
  return corner == 0 ? mesh : TriangleMesh{};
}

double distance_to_triangle(const Triangle& t, const Vector3d& p) {
  // Ericson, Real-Time Collision Detection, section 5.1.5: by Voronoi region.
  const Vector3d ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  const Vector3d bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).norm();
  const Vector3d cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1])).norm();
  return std::abs(ab.cross(ac).normalized().dot(ap));
}

/// Solid angle of a triangle seen from p (Van Oosterom and Strackee 1983).
double solid_angle(const Triangle& t, const Vector3d& p) {
  const Vector3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)),
                        la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

TriangleMesh read_stl(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be opened");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::uint32_t count = 0;
  if (bytes.size() >= kBinaryHeader) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  // The length alone tells: binary files may begin with "solid" too.
  const bool binary = count > 0 && bytes.size() == kBinaryHeader + count * kBinaryFacet;
  TriangleMesh mesh = binary ? parse_binary(bytes, count) : parse_ascii(bytes);
  if (mesh.empty())
    throw std::runtime_error(file.string() + ": no triangles; expected an STL file");
  return mesh;
}

bool is_closed(const TriangleMesh& mesh) {
  using Key = std::array<std::int64_t, 3>;
  const auto key = [](const Vector3d& p) {
    Key k{};
    for (int i = 0; i < 3; ++i) k[static_cast<std::size_t>(i)] = std::llround(p[i] * 1e6);
    return k;
  };
  std::map<std::pair<Key, Key>, int> edges;
  for (const Triangle& t : mesh)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{key(t[k]), key(t[(k + 1) % 3])}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    const auto back = edges.find({e.first.second, e.first.first});
    return e.second == 1 && back != edges.end() && back->second == 1;
  });
}

MassProperties mass_properties(const TriangleMesh& mesh) {
  MassProperties m;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();  // integral of x x^T about the origin
  for (const Triangle& t : mesh) {
    const Vector3d &a = t[0], &b = t[1], &c = t[2];
    const double six_v = a.dot(b.cross(c));
    const Vector3d sum = a + b + c;
    m.area_m2 += (b - a).cross(c - a).norm() / 2;
    m.volume_m3 += six_v / 6;
    first += six_v / 24 * sum;
    second += six_v / 120 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  m.com_m = first / m.volume_m3;
  const Matrix3d central = second - m.volume_m3 * m.com_m * m.com_m.transpose();
  m.inertia_m5 = central.trace() * Matrix3d::Identity() - central;
  return m;
}

double signed_distance(const TriangleMesh& mesh, const Vector3d& p) {
  double d = std::numeric_limits<double>::infinity(), angle = 0;
  for (const Triangle& t : mesh) {
    d = std::min(d, distance_to_triangle(t, p));
    angle += solid_angle(t, p);
  }
  return angle > 2 * M_PI ? d : -d;
}

}  // namespace dipper
