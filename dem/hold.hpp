// Holds rock at rest far from the machine, so that the cost of a step depends on the moving rock.
#pragma once

#include <mpi.h>

#include <vector>

#include "coupler/setup/rock_setup.hpp"
#include "dem/hold_policy.hpp"
#include "dem/parked_rock.hpp"

namespace LAMMPS_NS {
class LAMMPS;
class FixMultisphere;
}  // namespace LAMMPS_NS

namespace dipper::dem {

/// A moving body, for the check before a window.
struct MovingBody {
  Box box;  ///< in its frame
  Pose X_WB;
  Twist V_WB_W;
};

/// The LIGGGHTS group of the held layer.
inline constexpr const char* kLayerGroup = "held_layer";

/// Puts the rock of the layer into the group, before the first run. Collective.
void mark_layer(LAMMPS_NS::LAMMPS& lmp, const setup::HeldLayer& layer);

/// HoldRock's data of one rock, besides those of the rules.
struct HeldRecord {
  bool of_layer = false;  ///< held under any load; the same on every rank
  /// The integrators' bits of its spheres, taken from the mask while it rests. The same on every
  /// rank: a rock that has just crossed a boundary migrates as it comes to rest.
  int groups = 0;
  // For rock on this rank.
  Vector3d carried_N = Vector3d::Zero();  ///< held: compensates contacts that are not computed
  Vector3d excess_N =
      Vector3d::Zero();  ///< held: averaged change of its load since it came to rest
  Vector3d seen_p_W = Vector3d::Zero();  ///< its place at the last check of motion ...
  std::int64_t seen_step = -1;           ///< ... on this rank, at this step
};

/// All methods but the last two are collective.
///
/// A held rock keeps its place, and the forces on it are still computed; when the change of its
/// load since it came to rest exceeds a part of its weight, it wakes. Contact history is kept, so
/// the stress is unchanged when the rock wakes.
///
/// Rock of the group kLayerGroup is held from the beginning, under any load, until a moving wall
/// comes near; then it leaves the group and is treated as other rock. The group is saved.
///
/// The state of other resting rock is saved too: a checkpoint wakes nothing.
class HoldRock {
 public:
  HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm);

  /// Restores the saved state, after the rock in LIGGGHTS has been restored.
  HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm,
           ByteReader& in);
  void save(ByteWriter& out) const;

  /// Before each window of n steps.
  void before_window(std::int64_t n_steps, const std::vector<MovingBody>& bodies);

  /// Wakes all rock: before anything that needs all of it.
  void release();

  /// Holds the rock of the layer again.
  void hold_layer();

  /// Rock that is not in LIGGGHTS, on this rank. Changes only within the methods above.
  const std::vector<ParkedRock::Mass>& parked() const { return parked_.masses(); }
  const std::vector<ParkedRock::Sphere>& parked_spheres() const { return parked_.spheres(); }
  long spheres_parked() const { return static_cast<long>(parked_.spheres().size()); }

 private:
  struct Facts {
    bool body;
    int index;  ///< of the sphere or of the body, on this rank
    std::size_t rock;
    Vector3d v_W, force;
    double weight;
  };
  HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm,
           RockNumbers numbers);
  /// Steps in which LIGGGHTS itself writes rock: a restart file of the deck, or a dump other than
  /// the one that includes parked rock. It is written at the end of a step, within the window.
  bool all_rock_is_written(std::int64_t from, std::int64_t until) const;
  void unpark();
  template <typename Visit>
  void for_each_rock(const Visit& visit) const;
  void look(const std::vector<WallZone>& near, const std::vector<WallZone>& soon);
  void follow_loads(double dt_s);
  void look_at_motion(double dt_s);
  /// Moving rock as spheres with a clearance, and with their path of the next `ahead_s`; of all
  /// ranks.
  Reach moving(const std::vector<Rest>& rest, double gap_m, double ahead_s) const;
  /// Flags rock at rest that moving rock reaches.
  void expose(const std::vector<Rest>& rest, const Reach& reach);
  /// Joins the flags over the ranks.
  void join_flags();
  void apply(std::vector<Rest> rest);
  void set_held(const std::vector<Rest>& rest);

  LAMMPS_NS::LAMMPS& lmp_;
  LAMMPS_NS::FixMultisphere* bodies_;
  setup::HoldSettings settings_;
  MPI_Comm comm_;
  RockNumbers numbers_;
  RockDump* dump_;  ///< that shows parked rock, or null
  ParkedRock parked_;
  HoldPolicy policy_;
  double largest_m_ = 0;           ///< radius of the largest sphere
  int integrated_ = 0;             ///< mask bits of the groups of the spheres' integrators
  int layer_ = 0;                  ///< mask bit of the layer's group; 0: none
  int resting_ = 0;                ///< mask bit of kRestGroup
  std::vector<HeldRecord> rocks_;  ///< by number; what the rules keep of each is in policy_
  std::int64_t checked_ = 0, gathered_ = 0, followed_ = 0;  ///< steps of the last checks
  bool park_again_ = false;                                 ///< a dump needed all rock
};

}  // namespace dipper::dem
