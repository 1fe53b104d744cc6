#include "dem/moist/register_moist.hpp"

#include <atom.h>
#include <comm.h>
#include <error.h>
#include <fix_insert_stream.h>
#include <fix_mesh_surface.h>
#include <force.h>
#include <global_properties.h>
#include <lammps.h>
#include <modify.h>
#include <neighbor.h>
#include <tri_mesh.h>
#include <update.h>
#include <vector_liggghts.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

// These need the headers above.
#include <contact_models.h>
#include <fix_wall_gran_base.h>
#include <pair_gran_base.h>

#include "dem/own_fix.hpp"

namespace dipper::dem {
namespace {

using namespace LIGGGHTS::ContactModels;

using Style =
    GranStyle<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_MOIST, ROLLING_EPSD2, SURFACE_DEFAULT>;
using Model = ContactModel<Style>;
using Wall = LIGGGHTS::Walls::Granular<Model>;

/// Pairs act on each other across a gap: LIGGGHTS has one factor for that, `contactDistanceFactor`.
/// Walls must not have it: a mesh with history of a near triangle gives a sphere no force on the
/// next coplanar one (FixContactHistoryMesh::handleContact). So it is set only while pairs are
/// computed (Pair), and while lists are built, which keep the history of pairs within it (Reach).
constexpr double kFactor = 1 + moist::kReach;

class Reach final : public LAMMPS_NS::Fix {
 public:
  Reach(LAMMPS_NS::LAMMPS* l, int narg, char** arg) : Fix(l, narg, arg) {}
  int setmask() override { return LAMMPS_NS::FixConst::PRE_EXCHANGE; }
  void pre_exchange() override { neighbor->contactDistanceFactor = kFactor; }
  void setup_pre_exchange() override { pre_exchange(); }
};

class Pair final : public LIGGGHTS::PairStyles::Granular<Model> {
 public:
  Pair(LAMMPS_NS::LAMMPS* l, LAMMPS_NS::PairGran* parent, std::int64_t hash)
      : Granular(l, parent, hash), lmp_(l) {}

  void init_granular() override {
    Granular::init_granular();
    if (lmp_->modify->find_fix("moist_reach") < 0) add_own_fix<Reach>(lmp_, {"moist_reach", "all"});
  }

  void compute_force(LAMMPS_NS::PairGran* parent, int energy, int virial, int add) override {
    lmp_->neighbor->contactDistanceFactor = kFactor;
    Granular::compute_force(parent, energy, virial, add);
    lmp_->neighbor->contactDistanceFactor = 1;
  }

 private:
  LAMMPS_NS::LAMMPS* lmp_;
};

LIGGGHTS::PairStyles::IGranularPairStyle* make_pair(LAMMPS_NS::LAMMPS* lmp,
                                                    LAMMPS_NS::PairGran* parent,
                                                    std::int64_t hash) {
  return new Pair(lmp, parent, hash);
}

LIGGGHTS::Walls::IGranularWall* make_wall(LAMMPS_NS::LAMMPS* lmp, LAMMPS_NS::FixWallGran* parent,
                                          std::int64_t hash) {
  return new Wall(lmp, parent, hash);
}

}  // namespace

void register_moist() {
  static const bool once = [] {
    Factory::instance().addCohesionModel("moist", COHESION_MOIST);
    const auto key = static_cast<int>(Style::HASHCODE);
    LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", key, &make_pair);
    LIGGGHTS::Walls::Factory::instance().addStyle("gran", key, &make_wall);
    return true;
  }();
  static_cast<void>(once);
}

int bond_history_offset() { return CohesionModel<COHESION_MOIST>::pair_offset; }

}  // namespace dipper::dem
