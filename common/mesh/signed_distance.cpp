#include "common/mesh/signed_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dipper::mesh {
namespace {

using Eigen::Vector3d;

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

double signed_distance(const TriangleMesh& mesh, const Vector3d& p) {
  double d = std::numeric_limits<double>::infinity(), angle = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.corners(i);
    d = std::min(d, distance_to_triangle(t, p));
    angle += solid_angle(t, p);
  }
  return angle > 2 * M_PI ? d : -d;
}

bool is_surface_near(const TriangleMesh& mesh, const Vector3d& p, double distance_m) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (distance_to_triangle(mesh.corners(i), p) <= distance_m) return true;
  return false;
}

}  // namespace dipper::mesh
