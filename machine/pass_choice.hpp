// What an operator chooses from before a pass, and by what: planned on the face that he sees.
#pragma once

#include <string>
#include <vector>

#include "common/height_map.hpp"
#include "machine/handle_statics.hpp"
#include "machine/kinematics.hpp"
#include "machine/motion_plan.hpp"
#include "machine/pass_motion.hpp"

namespace dipper::machine {

/// The digs to choose from: every combination of the lists, each with the same rest.
struct DigChoice {
  std::vector<double> heading_rad, depth_m, floor_rise, exit_z_m;  ///< as Cut has them
  Vector2d start = Vector2d::Zero();
  double smooth_m = 0, crowd_max_m = 0;
  double teeth_m_s = 0;  ///< along the dig and up to the dump, where the drives can
};

/// What he knows of dipper and rock.
struct DigFacts {
  double bulk_density_kg_m3 = 0;
  double capacity_kg = 0;              ///< what the dipper takes
  double specific_resistance_Pa = 0;   ///< machine/cut_ahead.hpp
  Vector3d load_B = Vector3d::Zero();  ///< where the load's weight acts, m
  double half_width_m = 0;             ///< of the bench between its side walls,
  double walls_from_x_m = 0;           ///< which begin there, in W
};

/// What the passes before have shown.
struct DigExperience {
  double resistance = 1;  ///< of the rock, over the estimate's
  /// Of what the teeth sweep, what then is in the truck. Before the first pass: 81.7 t of the 97 t
  /// swept, the first pass at true size (docs/paper.md).
  double loaded = 0.84;
};

/// One dig, by an estimate.
struct DigCandidate {
  double heading_rad = 0, depth_m = 0, floor_rise = 0, exit_z_m = 0;
  std::string refused;      ///< why it cannot be dug; empty: it can
  TeethPath dig;            ///< control polygon of the teeth's way
  double swept_m3 = 0;      ///< taken out of the face
  double swept_kg = 0;      ///< of rock as it lies in a dipper
  double payload_kg = 0;    ///< of that, what the dipper holds; over `overload` where that is > 1
  double crowd_peak_N = 0;  ///< means over a metre of the teeth's way
  double hoist_peak_N = 0;
  double overload = 0;      ///< the larger of the two over what its drive gives; 0: not known
  double crowd_mean_N = 0;  ///< over the teeth's way in rock
  double rock_from_m = 0, rock_to_m = 0;  ///< of the teeth's way: where they are in rock
  double dig_force_mean_N = 0;            ///< sqrt(crowd^2 + hoist^2), while the teeth are in rock
  double dig_s = 0;                       ///< with the teeth in rock
  double cycle_s = 0;                     ///< from dump to dump
  double energy_J = 0;                    ///< that hoist and crowd put in from the dig to the dump
  double score = 0;                       ///< kg/s or kg/J
};

/// Candidates, and which is the best: that with the largest score. None: there is none of at least
/// the payload asked for.
struct DigDecision {
  std::vector<DigCandidate> candidates;
  int chosen = -1;
  std::string reason;  ///< of the choice, a sentence
  std::string rows;    ///< of motion.csv, from the pass's start until the dipper is empty
  PassTimes times;
  double rock_from_s = 0, rock_to_s = 0;  ///< of the motion: while the teeth are in rock
};

/// What a dipper that turns away from a face has to be over, m.
double rock_over_m(const HeightMap& face);

/// Judges every dig of the choice on a face: geometry, the least forces at rest in each place of
/// the way (weights, and the rock by Dombrovskij's formula), and the drives' limits: where it takes
/// up to twice what they give, he eases off in the dig and loads less. Rock that comes down while
/// he digs is not foreseen.
class DigPlanner {
 public:
  /// \param base_m  the swing axis at ground level, in W
  DigPlanner(const DigChoice& choice, const MotionPlan& cycle, const DigFacts& facts,
             const MachineData& machine, const Vector3d& base_m, double rake, DigGoal goal);

  /// \param least_kg  a pass with less does not pay
  /// \param most_kg  that the truck still takes: more payload counts for nothing
  DigDecision decide(const HeightMap& face, const PassStart& from, double least_kg, double most_kg,
                     const DigExperience& before = {}) const;

  const DigFacts& facts() const { return facts_; }
  /// In front of the face, where he stands before the first pass.
  PassStart start() const;
  /// The part of W that he looks at: as far as the dipper reaches, between the side walls and a
  /// metre beyond.
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
