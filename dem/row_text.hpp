// Rows of a dump as text, without insignificant digits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dipper::dem {

/// Decimals of a dump's columns. Positions are rounded to 1/500 of the smallest radius or finer,
/// velocities to ten times that length per second, angular velocities to twenty times that length
/// per second at the surface of the smallest sphere; each to a power of ten. The last digits of
/// rock at rest take most of a file.
class RowText {
 public:
  /// \param columns  names as in `dump custom`
  RowText(const std::vector<std::string>& columns, double smallest_radius_m);

  /// The rows as lines, sorted by the column `id` if there is one.
  /// \param rows  one after the other, as wide as there are columns
  std::string of(const std::vector<double>& rows) const;

 private:
  static constexpr int kGeneral = -1;
  std::vector<int> decimals_;  ///< kGeneral: whole numbers exactly, others with six digits
  std::size_t id_;             ///< its column, or the number of columns
};

}  // namespace dipper::dem
