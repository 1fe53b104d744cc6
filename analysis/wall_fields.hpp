// What a wall's dumps carry for each triangle: pressure, wear, whatever LIGGGHTS was told to dump.
#pragma once

#include "analysis/dump_folder.hpp"

namespace dipper {

struct WallField {
  std::string body, field;
  std::vector<Eigen::Vector3d> middle_m;  ///< of each triangle, in W at the last frame
  std::vector<double> area_m2;
  std::vector<double> last, mean, max;  ///< over the frames
  double time_s = 0;                    ///< of the last
};

/// Every array of cells of every wall but `meshid`; a vector counts by its length. Throws
/// InputError naming file and line: an array that comes and goes, triangles that change in number.
std::vector<WallField> read_wall_fields(const DumpFolder& dumps);

}  // namespace dipper
