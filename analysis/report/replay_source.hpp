// The data of the report's 3-D replay: frames of spheres, and walls that move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/frames.hpp"
#include "common/mesh/triangle_mesh.hpp"

namespace dipper::analysis::report {

/// One sphere of one frame, in W.
struct ReplaySphere {
  std::int64_t id = 0;
  std::int64_t rock = -1;  ///< number of the clump it belongs to; -1: it is a rock by itself
  int type = 1;            ///< size class, from 1
  float radius_m = 0;
  Eigen::Vector3f p_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f v_m_s = Eigen::Vector3f::Zero();
};

/// A wall. Its mesh is in its own frame, its state is the pose of that frame.
struct ReplayWall {
  std::string name;  ///< "dipper", "door", "truck"; other names are drawn too
  mesh::TriangleMesh mesh;
  std::vector<std::string> fields = {};  ///< values of each triangle: pressure, wear
};

using WallValues = std::vector<float>;  ///< of a field: one a triangle of the wall's mesh

struct ReplayFrame {
  double time_s = 0;
  std::vector<ReplaySphere> spheres;            ///< in any order
  std::vector<BodyState> walls;                 ///< one a wall, in their order
  std::vector<std::vector<WallValues>> values;  ///< of each wall's fields, as they are
};

/// Frames in order of time; each can be read repeatedly: the writer reads a run more than
/// once, so that no more than the spheres it keeps of one frame are in memory.
class ReplaySource {
 public:
  virtual ~ReplaySource() = default;
  virtual const std::vector<ReplayWall>& walls() const = 0;
  virtual const std::vector<double>& times_s() const = 0;
  /// Overwrites `frame` with the spheres that `keep` keeps; time and walls are in it when `keep` is
  /// first asked. Throws what the dump's reader throws.
  using Keep = std::function<bool(const ReplaySphere&)>;
  virtual void read(std::size_t index, ReplayFrame& frame, const Keep& keep) const = 0;
};

}  // namespace dipper::analysis::report
