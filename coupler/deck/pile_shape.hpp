// The bench in numbers: where its walls are and how much rock it takes.
#pragma once

#include "coupler/case/case.hpp"
#include "coupler/case/outline_file.hpp"

namespace dipper::deck {

/// In W, extruded over the width.
struct PileShape {
  double toe_x_m = 0;
  double rear_x_m = 0;       ///< the rear wall
  double height_m = 0;       ///< of the bench's highest point
  double pour_run_m = 0;     ///< from the toe to the pour's crest; 0: behind an upright form wall
  double volume_m3 = 0;      ///< what the pour fills: the bench, and what a form wall holds over it
  double mass_kg = 0;        ///< poured: that volume at kSettledFraction, and kPourExcess more
  double pour_height_m = 0;  ///< top of the poured rock, before it falls
};

/// Solid by bulk volume of settled rock: measured here (tests/coupler/deck); the paper's 1903 kg/m3
/// of 3700 kg/m3 is 0.51, for scanned shapes.
inline constexpr double kSettledFraction = 0.60;
/// Poured beyond the bench, so that cutting to its profile leaves no dents.
inline constexpr double kPourExcess = 1.10;
/// Solid by volume while it is in the air: what random insertion without overlap reaches.
inline constexpr double kPouredFraction = 0.30;

/// The pour fills the trapezoid, or the whole box behind the toe of a profile: rock stands at its
/// own angle, so a face is only as steep as the profile's when it is cut from a higher fill.
PileShape pile_shape(const cases::Case& c);

/// What the poured pile is cut to: the case's trapezoid or its profile; the highest section of a
/// surface.
cases::BenchOutline bench_outline(const cases::Case& c);

/// Its section along the boom at a heading [rad], x from the swing axis: further out and flatter
/// where the boom meets it aslant.
cases::BenchOutline bench_along_boom(const cases::Case& c, double heading_rad);

}  // namespace dipper::deck
