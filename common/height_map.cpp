#include "common/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/json_text.hpp"

namespace dipper {
namespace {

using nlohmann::json;

constexpr double kMostCells = 9000;  // at five characters a height they fit one packet
constexpr double kLayer_m = 0.01;    // of the text

int steps(double length_m, double cell_m) {
  return 1 + static_cast<int>(std::ceil(length_m / (0.5 * cell_m)));
}

json json_of(const HeightGrid& g) {
  return {{"x0_m", g.x0_m}, {"y0_m", g.y0_m}, {"cell_m", g.cell_m}, {"nx", g.nx}, {"ny", g.ny}};
}

HeightGrid grid_from(const json& j) {
  const HeightGrid g{j.at("x0_m"), j.at("y0_m"), j.at("cell_m"), j.at("nx"), j.at("ny")};
  if (!(g.cell_m > 0) || g.nx <= 0 || g.ny <= 0)
    throw std::runtime_error("a grid of heights needs cells");
  return g;
}

}  // namespace

HeightGrid face_grid(double x_from_m, double x_to_m, double y_from_m, double y_to_m) {
  const double x = std::max(0.0, x_to_m - x_from_m), y = std::max(0.0, y_to_m - y_from_m);
  const double cell = std::max(kFaceCell_m, std::sqrt(x * y / kMostCells));
  return {x_from_m, y_from_m, cell, std::max(1, static_cast<int>(std::ceil(x / cell - 1e-9))),
          std::max(1, static_cast<int>(std::ceil(y / cell - 1e-9)))};
}

HeightMap::HeightMap(const HeightGrid& grid, double z_m)
    : grid_(grid), z_(static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny), z_m) {}

std::optional<std::size_t> HeightMap::cell(double x_m, double y_m) const {
  const double i = std::floor((x_m - grid_.x0_m) / grid_.cell_m),
               j = std::floor((y_m - grid_.y0_m) / grid_.cell_m);
  if (!(i >= 0) || !(j >= 0) || i >= grid_.nx || j >= grid_.ny) return std::nullopt;
  return index(static_cast<int>(i), static_cast<int>(j));
}

double HeightMap::height(double x_m, double y_m) const {
  const auto k = cell(x_m, y_m);
  return k ? z_[*k] : 0;
}

HeightMap HeightMap::on(const HeightGrid& grid) const {
  HeightMap other(grid);
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j) other.at(i, j) = height(other.x_of(i), other.y_of(j));
  return other;
}

void HeightMap::add_ball(const Vector3d& centre_m, double radius_m) {
  const auto first = [&](double at, double zero) {
    return std::max(0, static_cast<int>(std::ceil((at - zero) / grid_.cell_m - 0.5)));
  };
  for (int i = first(centre_m.x() - radius_m, grid_.x0_m); i < grid_.nx; ++i) {
    const double dx = x_of(i) - centre_m.x();
    if (dx > radius_m) break;
    const double chord = std::sqrt(std::max(0.0, radius_m * radius_m - dx * dx));
    for (int j = first(centre_m.y() - chord, grid_.y0_m); j < grid_.ny; ++j) {
      const double dy = y_of(j) - centre_m.y();
      if (dy > chord) break;
      double& z = at(i, j);
      z = std::max(z, centre_m.z() + std::sqrt(std::max(0.0, chord * chord - dy * dy)));
    }
  }
}

double HeightMap::cut(const Vector3d& left_from, const Vector3d& right_from,
                      const Vector3d& left_to, const Vector3d& right_to) {
  const int across = steps((left_to - right_to).norm(), grid_.cell_m);
  const int along =
      steps(std::max((left_to - left_from).norm(), (right_to - right_from).norm()), grid_.cell_m);
  double volume_m3 = 0;
  for (int k = 1; k <= along; ++k) {
    const double t = static_cast<double>(k) / along;
    const Vector3d left = left_from + t * (left_to - left_from),
                   right = right_from + t * (right_to - right_from);
    for (int j = 0; j <= across; ++j) {
      const Vector3d p = left + (right - left) * j / across;
      const auto here = cell(p.x(), p.y());
      const double left_over_m = std::max(p.z(), 0.0);
      if (!here || z_[*here] <= left_over_m) continue;
      volume_m3 += (z_[*here] - left_over_m) * grid_.cell_m * grid_.cell_m;
      z_[*here] = left_over_m;
    }
  }
  return volume_m3;
}

std::vector<Eigen::Vector2d> HeightMap::profile(const Pose& X_WA, double half_width_m) const {
  const double far =
      std::hypot(std::max(std::abs(grid_.x0_m - X_WA.p.x()),
                          std::abs(grid_.x0_m + grid_.nx * grid_.cell_m - X_WA.p.x())),
                 std::max(std::abs(grid_.y0_m - X_WA.p.y()),
                          std::abs(grid_.y0_m + grid_.ny * grid_.cell_m - X_WA.p.y())));
  const int across = steps(2 * half_width_m, grid_.cell_m);
  std::vector<Eigen::Vector2d> line;
  std::vector<double> z;
  for (int k = 0; k * kProfileStep_m <= far; ++k) {
    const double x = k * kProfileStep_m;
    z.clear();
    for (int j = 0; j <= across; ++j) {
      const Vector3d p = X_WA * Vector3d(x, half_width_m * (2.0 * j / across - 1), 0);
      if (const auto here = cell(p.x(), p.y())) z.push_back(z_[*here]);
    }
    if (z.empty()) {
      if (line.empty()) continue;  // in front of the grid
      break;
    }
    const auto middle = z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2);
    std::nth_element(z.begin(), middle, z.end());
    line.emplace_back(x, *middle);
  }
  return line;
}

std::string to_json_text(const HeightGrid& grid) { return json_of(grid).dump(); }

HeightGrid height_grid_from(const std::string& json_text) {
  return grid_from(parse_json(json_text));
}

std::string to_json_text(const HeightMap& map) {
  json j = json_of(map.grid());
  json& z = j["z_cm"] = json::array();
  for (const double h : map.heights()) z.push_back(std::lround(h / kLayer_m));
  return j.dump();
}

HeightMap height_map_from(const std::string& json_text) {
  const json j = parse_json(json_text);
  HeightMap map(grid_from(j));
  const json& z = j.at("z_cm");
  if (z.size() != map.heights().size())
    throw std::runtime_error("the number of heights differs from the number of the grid's cells");
  for (std::size_t k = 0; k < z.size(); ++k)
    map.heights()[k] = static_cast<double>(z[k].get<long>()) * kLayer_m;
  return map;
}

}  // namespace dipper
