// The bench in numbers: where its walls are and how much rock it takes.
#pragma once

#include "coupler/case/case.hpp"
#include "coupler/deck/bench_cut.hpp"

namespace dipper {

/// In W; the bench's section is a trapezoid in (x, z), extruded over the width.
struct PileShape {
  double crest_x_m = 0;
  double rear_x_m = 0;       ///< the rear wall
  double volume_m3 = 0;      ///< of the bench
  double mass_kg = 0;        ///< poured: the bench at kSettledFraction, and kSpare more
  double pour_height_m = 0;  ///< top of the poured rock, before it falls
};

/// Solid by bulk volume of settled rock: measured here (tests/deck); the paper's 1903 kg/m3 of
/// 3700 kg/m3 is 0.51, for scanned shapes.
inline constexpr double kSettledFraction = 0.60;
/// Poured beyond the bench, so that cutting to its profile leaves no dents.
inline constexpr double kSpare = 1.10;
/// Solid by volume while it is in the air: what random insertion without overlap reaches.
inline constexpr double kPouredFraction = 0.30;

PileShape pile_shape(const Case& c);

/// What the poured pile is cut to.
BenchOutline bench_outline(const Case& c);

}  // namespace dipper
