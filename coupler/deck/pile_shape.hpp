// The bench in numbers: its walls and its amount of rock.
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
  double volume_m3 = 0;      ///< volume of the pour: the bench, and what a form wall holds above it
  double mass_kg = 0;        ///< poured: that volume at kSettledFraction, and kPourExcess more
  double pour_height_m = 0;  ///< top of the poured rock, before it falls
};

/// Solid fraction of settled rock, measured (tests/coupler/deck); the paper's 1903 kg/m3 of
/// 3700 kg/m3 is 0.51, for scanned shapes.
inline constexpr double kSettledFraction = 0.60;
/// Excess poured above the bench, so that cutting to its profile leaves no dents.
inline constexpr double kPourExcess = 1.10;
/// Solid fraction in the air: the limit of random insertion without overlap.
inline constexpr double kPouredFraction = 0.30;

/// The pour fills the trapezoid, or the whole box behind the toe of a profile: a face steeper than
/// the angle of repose has to be cut from a higher fill.
PileShape pile_shape(const cases::Case& c);

/// The outline to which the poured pile is cut: the case's trapezoid or its profile; the highest
/// section of a surface.
cases::BenchOutline bench_outline(const cases::Case& c);

/// Its section along the boom at a heading [rad], x from the swing axis: further out and flatter
/// where the boom meets it at an angle.
cases::BenchOutline bench_along_boom(const cases::Case& c, double heading_rad);

}  // namespace dipper::deck
