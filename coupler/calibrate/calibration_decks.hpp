// The two calibration decks for a case: size, number of rocks, and the measurement of their dumps.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/rock/pile_angle.hpp"
#include "coupler/calibrate/deck_runs.hpp"

namespace dipper::calibrate {

/// Diameter [m] of the largest class, coarse-grained.
double largest_rock(const cases::Case& c);

/// dem_in/calibrate_pile.in. Width and depth follow from the rock's size: in a narrower box the
/// walls would support the pile.
struct PileRig {
  double size_m = 0;   ///< lift of the sheet; the paper's 12.2 m are 14 of its largest rocks
  double width_m = 0;  ///< 4 of the largest rocks
  double depth_m = 0;  ///< the lift (docs/calibration.md); at least 3.5 of the largest rocks
};
inline constexpr double kPileSize = 7;  ///< default lift, in largest rocks
PileRig pile_rig(const cases::Case& c, double size_m);

/// dem_in/calibrate_box.in: a cube.
struct BoxRig {
  double edge_m = 0;
};
inline constexpr double kPaperBox_m = 3.037;  ///< edge of the paper's 28 m3
inline constexpr double kBoxEdge = 5;         ///< default edge, in largest rocks, if that is more

/// Mass that the deck pours [kg], and the number of rocks of each class.
double poured_mass(const cases::Case& c, const PileRig& rig);
double poured_mass(const cases::Case& c, const BoxRig& rig);
std::vector<double> poured_rocks(const cases::Case& c, double mass_kg);

DeckRun pile_run(const cases::Case& c, const PileRig& rig);
DeckRun box_run(const cases::Case& c, const BoxRig& rig);

/// The slope of the flank in front of the sheet. Throws std::runtime_error naming the dump when
/// there is none.
analysis::rock::PileAngle measure_pile(const std::filesystem::path& dump, const PileRig& rig);

struct BulkDensity {
  double box_kg_m3 = 0;  ///< all rock below the rim, by the box's volume: the paper's definition
  double interior_kg_m3 = 0;  ///< without a layer of one largest rock along walls and floor
};
BulkDensity measure_box(const cases::Case& c, const std::filesystem::path& dump, const BoxRig& rig);

}  // namespace dipper::calibrate
