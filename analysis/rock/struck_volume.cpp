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
    strides_ = {1, static_cast<std::size_t>(n_.x()),
                static_cast<std::size_t>(n_.x()) * static_cast<std::size_t>(n_.y())};
    blocked_.assign(3 * size(), 0);
    for (std::size_t c = 0; c < size(); ++c) {
      const Index i = index(c);
      for (int axis = 0; axis < 3; ++axis)
        if (i[axis] == n_[axis] - 1) blocked_[3 * c + static_cast<std::size_t>(axis)] = 1;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int axis = 0; axis < 3; ++axis) block(mesh.corners(t), axis);
  }

  std::size_t size() const { return strides_[2] * static_cast<std::size_t>(n_.z()); }
  Index index(std::size_t c) const {
    return {static_cast<int>(c % strides_[1]), static_cast<int>(c % strides_[2] / strides_[1]),
            static_cast<int>(c / strides_[2])};
  }
  Vector3d centre(const Index& i) const {
    return origin_ + cell_ * (i.cast<double>() + Vector3d::Constant(0.5));
  }
  bool at_border(const Index& i) const {
    return (i.array() == 0).any() || (i.array() == n_.array() - 1).any();
  }
  /// Calls `visit` with each neighbour of cell c that no triangle separates from it.
  template <class Visit>
  void neighbours(std::size_t c, const Visit& visit) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t stride = strides_[axis];
      if (blocked_[3 * c + axis] == 0) visit(c + stride);
      if (c >= stride && blocked_[3 * (c - stride) + axis] == 0) visit(c - stride);
    }
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

  std::size_t at(const Index& i) const {
    return static_cast<std::size_t>(i.x()) + strides_[1] * static_cast<std::size_t>(i.y()) +
           strides_[2] * static_cast<std::size_t>(i.z());
  }

  static double cross(const Vector3d& a, const Vector3d& b, int u, int v) {
    return a[u] * b[v] - a[v] * b[u];
  }

  double cell_;
  Vector3d origin_;
  Index n_ = Index::Zero();
  std::array<std::size_t, 3> strides_{};  ///< from a cell to the next along each axis
  std::vector<char> blocked_;  ///< by cell and axis: whether a triangle or the border comes next
};

/// The volume of the water that stays in the mesh when all is flooded and the border is a drain.
///
/// Water in a cell stands as high as the lowest way out. So a cell is dry if a way that only rises
/// leads to it from the border; no order is needed for these. Where a dry cell has a lower
/// neighbour, water stands behind this rim: rims are taken from the lowest on, and the pit behind
/// each is filled to its height (priority flood: Barnes et al. 2014, Comput. Geosci. 62:117-127).
double flood(const CellGrid& grid, const Vector3d& up, double cell, Box* water) {
  std::vector<double> height(grid.size());
  std::vector<char> seen(grid.size(), 0);
  std::vector<std::size_t> dry, pit;
  dry.reserve(grid.size());
  for (std::size_t c = 0; c < grid.size(); ++c) {
    const Index i = grid.index(c);
    height[c] = up.dot(grid.centre(i));
    if (!grid.at_border(i)) continue;
    seen[c] = 1;
    dry.push_back(c);
  }
  using Rim = std::pair<double, std::size_t>;  // height, cell
  std::priority_queue<Rim, std::vector<Rim>, std::greater<>> rims;
  const auto climb = [&](std::size_t first) {
    for (std::size_t k = first; k < dry.size(); ++k) {
      const std::size_t c = dry[k];
      grid.neighbours(c, [&](std::size_t next) {
        if (seen[next] != 0 || height[next] < height[c]) return;
        seen[next] = 1;
        dry.push_back(next);
      });
    }
    for (std::size_t k = first; k < dry.size(); ++k) {
      bool is_rim = false;
      grid.neighbours(dry[k], [&](std::size_t next) { is_rim = is_rim || seen[next] == 0; });
      if (is_rim) rims.emplace(height[dry[k]], dry[k]);
    }
  };
  climb(0);
  std::size_t held = 0;
  while (!rims.empty()) {
    const auto [level, rim] = rims.top();
    rims.pop();
    const std::size_t first = dry.size();
    pit.push_back(rim);
    while (!pit.empty()) {
      const std::size_t c = pit.back();
      pit.pop_back();
      grid.neighbours(c, [&, level = level](std::size_t next) {
        if (seen[next] != 0) return;
        seen[next] = 1;
        (height[next] > level ? dry : pit).push_back(next);
        if (height[next] >= level - 1e-9) return;
        ++held;
        if (water != nullptr) water->add(grid.centre(grid.index(next)), cell / 2);
      });
    }
    climb(first);
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
