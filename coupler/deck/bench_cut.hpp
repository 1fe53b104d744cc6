// The rocks above the bench's surface, which are cut away from the poured pile.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace dipper::deck {

/// Part of the cache key of a settled bench: increase it when the same pile is cut differently.
constexpr int kBenchCutVersion = 1;

/// A sphere of the pile. Those of one rock share its number; a single sphere has -1.
struct PileSphere {
  long id = 0, rock = -1;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

/// Ids of the spheres of all rocks whose centre lies over `height` at its x and y, in the order
/// given. A rock is cut or kept as a whole, by its centre (the mean of its spheres by volume): by
/// its highest sphere, the cut would remove more of the large rocks.
std::vector<long> over_surface(const std::vector<PileSphere>& spheres,
                               const std::function<double(double x_m, double y_m)>& height);

/// LIGGGHTS commands that put exactly these spheres into the group `waste`, which is empty or new.
std::string waste_group(const std::vector<long>& ids);

}  // namespace dipper::deck
