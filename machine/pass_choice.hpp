// The choice of a dig before each pass, on the face as it is.
#pragma once

#include <string>
#include <vector>

#include "common/height_map.hpp"
#include "machine/handle_statics.hpp"
#include "machine/kinematics.hpp"
#include "machine/motion_plan.hpp"
#include "machine/pass_motion.hpp"

namespace dipper::machine {

/// The digs to choose from: every combination of the lists; the other values are common to all.
struct DigChoice {
  std::vector<double> heading_rad, depth_m, floor_rise, exit_z_m;  ///< as Cut has them
  Vector2d start = Vector2d::Zero();
  double smooth_m = 0, crowd_max_m = 0;
  double teeth_m_s = 0;  ///< along dig and lift, where the drives can
};

/// What is known of dipper and rock.
struct DigFacts {
  double bulk_density_kg_m3 = 0;
  double capacity_kg = 0;              ///< of the dipper
  double specific_resistance_Pa = 0;   ///< machine/cut_ahead.hpp
  Vector3d load_B = Vector3d::Zero();  ///< where the load's weight acts, m
  double half_width_m = 0;             ///< of the bench between its side walls,
  double walls_from_x_m = 0;           ///< which begin there, in W
};

/// What the passes so far have shown.
struct DigExperience {
  double resistance = 1;  ///< of the rock, over the estimate's
  /// Of what the teeth sweep, what then is in the truck. Before the first pass: 81.7 t of the 97 t
  /// swept, the first pass at true size (docs/paper.md).
  double loaded = 0.84;
};

/// One dig, by an estimate.
struct DigCandidate {
  double heading_rad = 0, depth_m = 0, floor_rise = 0, exit_z_m = 0;
  std::string refused;      ///< why it is not feasible; empty: it is
  TeethPath dig;            ///< control polygon of the path of the teeth
  double swept_m3 = 0;      ///< removed from the face
  double loose_kg = 0;      ///< loaded of that, divided by `overload` where that is > 1
  double payload_kg = 0;    ///< expected in the dipper, which holds a heaped load at most
  double crowd_peak_N = 0;  ///< largest mean over a metre of the path
  double hoist_peak_N = 0;
  double overload = 0;      ///< the larger ratio of the two to the stall force of its drive
  double crowd_mean_N = 0;  ///< over the path in rock
  double rock_from_m = 0, rock_to_m = 0;  ///< along the path: where the teeth are in rock
  double dig_force_mean_N = 0;            ///< sqrt(crowd^2 + hoist^2), while the teeth are in rock
  double dig_s = 0;                       ///< with the teeth in rock
  double cycle_s = 0;                     ///< from dump to dump
  double energy_J = 0;                    ///< work of hoist and crowd from the dig to the dump
  double score = 0;                       ///< kg/s or kg/J
};

/// The candidates, and the one with the largest score of those with at least the least payload.
struct DigDecision {
  std::vector<DigCandidate> candidates;
  int chosen = -1;     ///< index; -1: none
  std::string reason;  ///< for the choice
  std::string rows;    ///< of motion.csv, from the pass's start until the dipper is empty
  PassTimes times;
  double rock_from_s = 0, rock_to_s = 0;  ///< of the motion: while the teeth are in rock
};

/// The height that the dipper must clear before the house turns, m.
double rock_over_m(const HeightMap& face);

/// Evaluates every dig of the choice on a face: geometry, the static forces along the path
/// (weights, and the rock's resistance by Dombrovskij's formula), and the limits of the drives. A
/// dig that needs up to twice the stall force of a drive is feasible with limited drives: it is
/// slower and loads less. Rock that slides down during the dig is not predicted.
class DigPlanner {
 public:
  /// \param base_m  the swing axis at ground level, in W
  DigPlanner(const DigChoice& choice, const MotionPlan& cycle, const DigFacts& facts,
             const MachineData& machine, const Vector3d& base_m, double rake, DigGoal goal);

  /// \param least_kg  a pass with less does not pay
  /// \param most_kg  that the truck still takes: payload beyond it has no value
  DigDecision decide(const HeightMap& face, const PassStart& from, double least_kg, double most_kg,
                     const DigExperience& before = {}) const;

  const DigFacts& facts() const { return facts_; }
  /// The start of the first pass, in front of the face.
  PassStart start() const;
  /// The grid of the height map: as far as the dipper reaches, to a metre beyond the side walls.
  HeightGrid grid() const;

 private:
  void choose(DigDecision& decision, const HeightMap& face, const PassStart& from,
              double least_kg) const;

  DigChoice choice_;
  MotionPlan cycle_;
  DigFacts facts_;
  MachineData machine_;
  Vector3d base_m_;
  ShovelKinematics shovel_;
  HandleStatics statics_;
  DigGoal goal_;
};

}  // namespace dipper::machine
