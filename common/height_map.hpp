// Heights over the ground on a grid: a bench as it is seen from above, and dug away.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace dipper {

/// Square cells in W, from a corner on.
struct HeightGrid {
  double x0_m = 0, y0_m = 0;
  double cell_m = 0;
  int nx = 0, ny = 0;
};

/// The grid over a rectangle: cells of kFaceCell_m, larger where there would be more than a message
/// between the sides can hold.
HeightGrid face_grid(double x_from_m, double x_to_m, double y_from_m, double y_to_m);
inline constexpr double kFaceCell_m = 0.2;

/// z(x, y) in W, one height a cell.
class HeightMap {
 public:
  explicit HeightMap(const HeightGrid& grid, double z_m = 0);

  const HeightGrid& grid() const { return grid_; }

  /// m; 0 beyond the grid.
  double height(double x_m, double y_m) const;

  /// Of a cell, and of its middle.
  double& at(int i, int j) { return z_[index(i, j)]; }
  double at(int i, int j) const { return z_[index(i, j)]; }
  double x_of(int i) const { return grid_.x0_m + (i + 0.5) * grid_.cell_m; }
  double y_of(int j) const { return grid_.y0_m + (j + 0.5) * grid_.cell_m; }

  std::vector<double>& heights() { return z_; }
  const std::vector<double>& heights() const { return z_; }

  /// The same surface in the cells of another grid.
  HeightMap on(const HeightGrid& grid) const;

  /// Raises every cell whose middle the ball is over to the ball's top there. So a map of a bed of
  /// balls has the height of the highest ball over each cell's middle.
  void add_ball(const Vector3d& centre_m, double radius_m);

  /// Takes out what lies above the quadrangle that an edge sweeps as it goes from one place to
  /// another: volume, m^3. Nothing comes down; the ground at z = 0 stays.
  double cut(const Vector3d& left_from, const Vector3d& right_from, const Vector3d& left_to,
             const Vector3d& right_to);

  /// Along the x axis of a frame that stands on the ground, from 0 to the end of the grid: the
  /// median over |y| <= half_width_m, every kProfileStep_m. A rock that rolled away does not lift
  /// it.
  std::vector<Eigen::Vector2d> profile(const Pose& X_WA, double half_width_m) const;

  static constexpr double kProfileStep_m = 0.1;

 private:
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(grid_.ny) +
           static_cast<std::size_t>(j);
  }
  std::optional<std::size_t> cell(double x_m, double y_m) const;

  HeightGrid grid_;
  std::vector<double> z_;  ///< x slow, y fast
};

/// As text in JSON, heights to the centimetre, and back. Reading throws
/// nlohmann::json::exception, or std::runtime_error when the heights are not as many as the cells.
std::string to_json_text(const HeightGrid& grid);
HeightGrid height_grid_from(const std::string& json_text);
std::string to_json_text(const HeightMap& map);
HeightMap height_map_from(const std::string& json_text);

}  // namespace dipper
