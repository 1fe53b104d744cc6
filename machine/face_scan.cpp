#include "machine/face_scan.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace dipper::machine {
namespace {

/// Normally distributed (Box and Muller 1958): the same on every machine, which the library's own
/// distribution need not be.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : bits_(seed) {}
  double next() {
    const double u = unit(), v = unit();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
  }

 private:
  double unit() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1.0p-53; }
  std::mt19937_64 bits_;
};

/// Whether the line from the eye to the surface over a cell is free, and how steeply it comes.
bool is_seen(const HeightMap& face, int i, int j, const Vector3d& eye, double dead_angle) {
  const double cell = face.grid().cell_m;
  const Vector3d p(face.x_of(i), face.y_of(j), face.at(i, j));
  const Vector3d line = p - eye;
  const auto z = [&](int m, int n) {
    return face.at(std::clamp(m, 0, face.grid().nx - 1), std::clamp(n, 0, face.grid().ny - 1));
  };
  const Vector3d normal = Vector3d(-(z(i + 1, j) - z(i - 1, j)) / (2 * cell),
                                   -(z(i, j + 1) - z(i, j - 1)) / (2 * cell), 1)
                              .normalized();
  if (std::asin(std::clamp(-line.normalized().dot(normal), -1.0, 1.0)) < dead_angle) return false;
  const int steps = static_cast<int>(std::ceil(line.head<2>().norm() / cell));
  for (int k = 1; k < steps; ++k) {
    const Vector3d q = eye + line * (static_cast<double>(k) / steps);
    if ((q - p).head<2>().norm() < cell) break;
    if (face.height(q.x(), q.y()) > q.z()) return false;
  }
  return true;
}

/// Puts heights in between those that are seen, along a row of cells.
void fill_row(HeightMap& face, const std::vector<bool>& seen, int j) {
  const int n = face.grid().nx;
  int last = -1;
  for (int i = 0; i <= n; ++i) {
    if (i < n && !seen[static_cast<std::size_t>(i)]) continue;
    for (int k = last + 1; k < i; ++k) {
      if (last < 0 && i == n) return;  // a row of which nothing is seen stays as it was
      const double share = last < 0 ? 1 : i == n ? 0 : static_cast<double>(k - last) / (i - last);
      face.at(k, j) =
          (last < 0 ? 0 : (1 - share) * face.at(last, j)) + (i == n ? 0 : share * face.at(i, j));
    }
    last = i;
  }
}

}  // namespace

HeightMap scanned(const HeightMap& face, const Vector3d& eye_W, const ScanErrors& errors,
                  std::uint64_t seed) {
  HeightMap out = face;
  if (errors.height_m > 0) {
    Noise noise(seed);
    for (double& z : out.heights()) z = std::max(0.0, z + errors.height_m * noise.next());
  }
  if (!(errors.dead_angle_rad > 0)) return out;
  std::vector<bool> seen(static_cast<std::size_t>(face.grid().nx));
  for (int j = 0; j < face.grid().ny; ++j) {
    for (int i = 0; i < face.grid().nx; ++i)
      seen[static_cast<std::size_t>(i)] = is_seen(face, i, j, eye_W, errors.dead_angle_rad);
    fill_row(out, seen, j);
  }
  return out;
}

}  // namespace dipper::machine
