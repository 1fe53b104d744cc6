// What the report's 3-D replay is drawn from: frames of spheres, and walls that move.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coupler/core/frames.hpp"
#include "coupler/mesh/triangle_mesh.hpp"

namespace dipper {

/// One sphere of one frame, in W.
struct ReplaySphere {
  std::int64_t id = 0;
  std::int64_t rock = -1;  ///< number of the clump it belongs to; -1: it is a rock by itself
  int type = 1;            ///< size class, from 1
  float radius_m = 0;
  Eigen::Vector3f p_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f v_m_s = Eigen::Vector3f::Zero();
};

/// A wall. Its mesh is drawn in its own frame, its state says where that frame is.
struct ReplayWall {
  std::string name;  ///< "dipper", "door", "truck"; other names are drawn too
  TriangleMesh mesh;
};

struct ReplayFrame {
  double time_s = 0;
  std::vector<ReplaySphere> spheres;  ///< in any order
  std::vector<BodyState> walls;       ///< one a wall, in their order
};

/// Frames in order of time, any of which can be asked for again: the writer reads a run twice, so
/// that no more than one frame is in memory.
class ReplaySource {
 public:
  virtual ~ReplaySource() = default;
  virtual const std::vector<ReplayWall>& walls() const = 0;
  virtual const std::vector<double>& times_s() const = 0;
  /// Overwrites `frame`. Throws what the dump's reader throws.
  virtual void read(std::size_t index, ReplayFrame& frame) const = 0;
};

}  // namespace dipper
