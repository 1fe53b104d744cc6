#include "analysis/rock/struck_volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace dipper::analysis::rock {
namespace {

using Eigen::Vector3d;
using Index = Eigen::Vector3i;

/// Cells over a mesh's box and one layer around it, and which neighbours a triangle separates.
class CellGrid {
 public:
  /// `shift`: in cells, 0 ... 1 along each axis.
  CellGrid(const mesh::TriangleMesh& mesh, double cell, const Vector3d& shift) : cell_(cell) {
    const Box box = mesh::bounding_box(mesh);
    origin_ = box.min_m - cell * (Vector3d::Ones() + shift);
    for (int k = 0; k < 3; ++k)
      n_[k] = static_cast<int>(std::ceil((box.max_m[k] - origin_[k]) / cell)) + 2;
    blocked_.assign(3 * size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int axis = 0; axis < 3; ++axis) block(mesh.corners(t), axis);
  }

  std::size_t size() const {
    return static_cast<std::size_t>(n_.x()) * static_cast<std::size_t>(n_.y()) *
           static_cast<std::size_t>(n_.z());
  }
  std::size_t at(const Index& i) const {
    return (static_cast<std::size_t>(i.z()) * static_cast<std::size_t>(n_.y()) +
            static_cast<std::size_t>(i.y())) *
               static_cast<std::size_t>(n_.x()) +
           static_cast<std::size_t>(i.x());
  }
  Index index(std::size_t c) const {
    const auto nx = static_cast<std::size_t>(n_.x()), ny = static_cast<std::size_t>(n_.y());
    return {static_cast<int>(c % nx), static_cast<int>(c / nx % ny),
            static_cast<int>(c / (nx * ny))};
  }
  Vector3d centre(const Index& i) const {
    return origin_ + cell_ * (i.cast<double>() + Vector3d::Constant(0.5));
  }
  const Index& n() const { return n_; }
  /// Whether a triangle lies between cell i and the next along the axis.
  bool blocked(const Index& i, int axis) const {
    return blocked_[3 * at(i) + static_cast<std::size_t>(axis)] != 0;
  }

 private:
  /// Marks where the lines of cell centres along an axis cross the triangle.
  void block(const mesh::Triangle& t, int axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto cell_of = [&](double x, int k) { return (x - origin_[k]) / cell_ - 0.5; };
    const auto lowest = [&](int k) {
      return std::max(
          0, static_cast<int>(std::ceil(cell_of(std::min({t[0][k], t[1][k], t[2][k]}), k))));
    };
    const auto highest = [&](int k) {
      return std::min(
          n_[k] - 1,
          static_cast<int>(std::floor(cell_of(std::max({t[0][k], t[1][k], t[2][k]}), k))));
    };
    const double area = cross(t[1] - t[0], t[2] - t[0], u, v);
    if (area == 0) return;
    for (int i = lowest(u); i <= highest(u); ++i) {
      for (int j = lowest(v); j <= highest(v); ++j) {
        Vector3d p = Vector3d::Zero();
        p[u] = origin_[u] + cell_ * (i + 0.5);
        p[v] = origin_[v] + cell_ * (j + 0.5);
        const double a = cross(t[1] - p, t[2] - p, u, v) / area;
        const double b = cross(t[2] - p, t[0] - p, u, v) / area;
        if (a < 0 || b < 0 || a + b > 1) continue;
        const double w = a * t[0][axis] + b * t[1][axis] + (1 - a - b) * t[2][axis];
        const int k = static_cast<int>(std::floor(cell_of(w, axis)));
        if (k < 0 || k >= n_[axis]) continue;
        Index c;
        c[u] = i;
        c[v] = j;
        c[axis] = k;
        blocked_[3 * at(c) + static_cast<std::size_t>(axis)] = 1;
      }
    }
  }

  static double cross(const Vector3d& a, const Vector3d& b, int u, int v) {
    return a[u] * b[v] - a[v] * b[u];
  }

  double cell_;
  Vector3d origin_;
  Index n_ = Index::Zero();
  std::vector<char> blocked_;
};

double flood(const CellGrid& grid, const Vector3d& up, double cell, Box* water) {
  using Entry = std::pair<double, std::size_t>;  // level, cell
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  std::vector<char> seen(grid.size(), 0);
  const Index& n = grid.n();
  for (std::size_t c = 0; c < grid.size(); ++c) {
    const Index i = grid.index(c);
    if ((i.array() > 0).all() && (i.array() < n.array() - 1).all()) continue;
    seen[c] = 1;
    queue.emplace(up.dot(grid.centre(i)), c);
  }
  std::size_t held = 0;
  while (!queue.empty()) {
    const auto [level, c] = queue.top();
    queue.pop();
    const Index i = grid.index(c);
    const Vector3d p = grid.centre(i);
    if (up.dot(p) < level - 1e-9) {
      ++held;
      if (water != nullptr) water->add(p, cell / 2);
    }
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Index j = i;
        j[axis] += side;
        if (j[axis] < 0 || j[axis] >= n[axis]) continue;
        if (seen[grid.at(j)] != 0 || grid.blocked(side > 0 ? i : j, axis)) continue;
        seen[grid.at(j)] = 1;
        queue.emplace(std::max(level, up.dot(grid.centre(j))), grid.at(j));
      }
    }
  }
  return static_cast<double>(held) * cell * cell * cell;
}

constexpr double kTight = 0.9;

/// The k-th of several grids: each is shifted by another eighth of a cell along each axis.
constexpr int kGrids = 8;
Vector3d shift(int k) {
  const auto eighth = [](int i) { return (i % kGrids + 0.5) / kGrids; };
  return {eighth(k), eighth(3 * k + 1), eighth(5 * k + 2)};
}

/// Directions near `around`, at angles up to `spread`: eight around it.
std::vector<Vector3d> cone(const Vector3d& around, double spread) {
  const Vector3d a = around.unitOrthogonal(), b = around.cross(a);
  std::vector<Vector3d> out;
  for (int k = 0; k < 8; ++k) {
    const double phi = k * M_PI / 4;
    out.push_back(
        (std::cos(spread) * around + std::sin(spread) * (std::cos(phi) * a + std::sin(phi) * b)));
  }
  return out;
}

}  // namespace

double water_held(const mesh::TriangleMesh& mesh, const Vector3d& up, double cell_m, Box* water) {
  std::array<double, kGrids> held{};
  for (int k = 0; k < kGrids; ++k) {
    Box box;
    held[static_cast<std::size_t>(k)] = flood(CellGrid(mesh, cell_m, shift(k)), up, cell_m, &box);
    if (water == nullptr || box.is_empty()) continue;
    water->add(box.min_m);
    water->add(box.max_m);
  }
  // On this grid a row of cells lies in a narrow gap, and the water ran out.
  const double most = *std::max_element(held.begin(), held.end());
  double sum = 0;
  int tight = 0;
  for (const double v : held) {
    if (v < kTight * most) continue;
    sum += v;
    ++tight;
  }
  return sum / tight;
}

StruckVolume struck_volume(const mesh::TriangleMesh& mesh, const StruckOptions& options) {
  const Box box = mesh::bounding_box(mesh);
  const double side = box.sides_m().maxCoeff();
  const double cell = options.cell_m > 0 ? options.cell_m : side / 60;
  const double coarse = std::max(cell, side / 36);
  const CellGrid grid(mesh, coarse, shift(2));
  StruckVolume best;
  const auto take = [&](const Vector3d& up) {
    const double v = flood(grid, up, coarse, nullptr);
    if (v <= best.volume_m3) return false;
    best.volume_m3 = v;
    best.up = up;
    return true;
  };
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) take(Vector3d(x, y, z).normalized());
  if (best.volume_m3 == 0) return best;
  for (double spread = 0.35; spread > 0.02;) {
    bool better = false;
    const Vector3d around = best.up;
    for (const Vector3d& up : cone(around, spread)) better = take(up) || better;
    if (!better) spread /= 2;
  }
  best.volume_m3 = water_held(mesh, best.up, cell, &best.water);
  return best;
}

}  // namespace dipper::analysis::rock
