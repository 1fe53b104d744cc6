// Poses of bodies against time, from a table: the motion of machine.kind poses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace dipper::machine {

/// A body passes its rows smoothly: each coordinate of its origin is a cubic between two rows that
/// does not overshoot them (monotone_slope.hpp), and so is the rotation vector from one row to the
/// next, along the shorter arc. It starts and ends at rest, and does not move before its first
/// row or after its last.
class PoseTable {
 public:
  struct Row {
    std::int64_t t_ns;
    Pose X_WB;
    int line;  ///< of its file
  };

  /// Reads time_s,body,x_m,y_m,z_m,qw,qx,qy,qz: position and orientation of the body's frame in W,
  /// a unit quaternion. Rows of several bodies may alternate; times of each must rise. Throws
  /// InputError naming file and line.
  static PoseTable load(const std::filesystem::path& file);

  /// In the order of their names.
  std::vector<std::string> bodies() const;
  bool has(const std::string& body) const { return tracks_.count(body) != 0; }

  /// A body's rows in order. Throws std::out_of_range for a body that is not in the table.
  const std::vector<Row>& rows(const std::string& body) const { return tracks_.at(body).rows; }

  /// Throws std::out_of_range for a body that is not in the table.
  BodyState at(const std::string& body, std::int64_t t_ns) const;

  /// The last row's time; 0, where a run begins, if that is before it.
  std::int64_t end_ns() const;

 private:
  struct Track {
    std::vector<Row> rows;
    std::vector<Twist> V_WB_W;  ///< at the rows
  };
  static void set_slopes(Track& track);

  std::map<std::string, Track> tracks_;
};

}  // namespace dipper::machine
