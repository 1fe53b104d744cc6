// Rows of a dump as text, without digits that tell nothing.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dipper::dem {

/// Decimals of a dump's columns. Positions are told to 1/500 of the smallest radius or finer,
/// velocities per second to ten times that length, angular velocities so that the surface of the
/// smallest sphere is told to twenty times; each to a power of ten. Of rock at rest, whose last
/// digits are what costs most, nothing else is lost.
class RowText {
 public:
  /// \param columns  names, as `dump custom` has them
  RowText(const std::vector<std::string>& columns, double smallest_radius_m);

  /// These rows, a line each, by the column `id` where there is one.
  /// \param rows  one after the other, as wide as there are columns
  std::string of(const std::vector<double>& rows) const;

 private:
  static constexpr int kGeneral = -1;
  std::vector<int> decimals_;  ///< of each column; kGeneral: whole numbers whole, else six digits
  std::size_t id_;             ///< its column, or the number of columns
};

}  // namespace dipper::dem
