// motion.csv: the motion of the four drives as smooth functions of time.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/csv_table.hpp"

namespace dipper::machine {

/// One number for each drive: positions, or their first or second time derivatives.
struct Drives {
  double hoist = 0;  ///< m; rope paid out beyond its length at hoist 0: negative lifts the dipper
  double crowd = 0;  ///< m; the handle pushed out through the saddle block
  double swing = 0;  ///< rad; the house about W's z, positive to the left
  double door = 0;   ///< rad; opening, about B's y
};

/// The drives at one instant.
struct DriveState {
  Drives position;      ///< m, rad
  Drives rate;          ///< m/s, rad/s
  Drives acceleration;  ///< m/s^2, rad/s^2
};

/// A motion read from rows of (time, four positions).
///
/// Between rows: the cubic Hermite polynomial with the slopes of the parabola through three
/// neighbouring rows, limited to keep each interval monotone (Hyman 1983, SIAM J. Sci. Stat.
/// Comput. 4:645). Rates are continuous, accelerations finite. The machine stands still before the
/// first row and after the last: the rates at both are zero.
class Motion {
 public:
  /// Reads a table (common/csv_table.hpp) of time_s,hoist_m,crowd_m,swing_deg,door_deg. Throws
  /// InputError with every fault found, with line and column.
  static Motion load(const std::filesystem::path& file);

  /// The same from text; `name` stands for the file in messages.
  static Motion parse(std::string_view text, const std::string& name);

  /// One that stands where this begins.
  Motion standing() const;

  /// Goes on with the rows of another motion. Throws std::invalid_argument when its first row is
  /// not after the last of this one.
  void extend(const Motion& more);

  Drives value(std::int64_t t_ns) const;
  Drives rate(std::int64_t t_ns) const;
  Drives acceleration(std::int64_t t_ns) const;

  /// Position, rate and acceleration at a time in seconds, for an integrator's stages between
  /// ticks.
  DriveState at(double t_s) const;

  /// The first row after a time, where the acceleration may jump; int64's maximum after the last.
  std::int64_t next_row_ns(std::int64_t t_ns) const;

  std::int64_t start_ns() const { return t_ns_.front(); }
  std::int64_t end_ns() const { return t_ns_.back(); }

 private:
  Motion() = default;
  Motion(const std::vector<CsvRow>& rows, const std::filesystem::path& file,
         std::vector<Finding> faults);
  void set_slopes();

  std::vector<std::int64_t> t_ns_;
  std::vector<std::array<double, 4>> position_;
  std::vector<std::array<double, 4>> slope_;
};

}  // namespace dipper::machine
