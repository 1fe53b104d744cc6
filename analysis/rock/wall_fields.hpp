// The values that a wall's dumps have for each triangle: pressure, wear, and other dumped fields.
#pragma once

#include "analysis/io/dump_folder.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::rock {

/// One dump of a wall, with the triangles in the order of their numbers (`meshid`), which is that
/// of the wall's STL file: ranks may write them in any order.
struct WallFrame {
  mesh::TriangleMesh mesh;                            ///< in W
  std::map<std::string, std::vector<double>> fields;  ///< all but `meshid`; of a vector its length
  std::map<std::string, long> line;                   ///< of each field in the file
};
WallFrame read_wall_frame(const std::filesystem::path& file);

struct WallField {
  std::string body, field;
  std::vector<Eigen::Vector3d> middle_m;  ///< centre of each triangle, in W at the last frame
  std::vector<double> area_m2;
  std::vector<double> last, mean, max;  ///< over the frames that have the field
  double time_s = 0;                    ///< of the last
};

/// Every field of every wall; frames without it do not count. Throws InputError naming file and
/// line where the number of triangles changes.
std::vector<WallField> read_wall_fields(const io::DumpFolder& dumps);

}  // namespace dipper::analysis::rock
