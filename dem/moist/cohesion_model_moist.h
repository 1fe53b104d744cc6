// The cohesion model `moist` of LIGGGHTS: moist_law.hpp between rocks, and moist fines on walls.
//
//   pair_style gran model hooke/stiffness tangential history cohesion moist rolling_friction epsd2
//   ...
//
// The deck must have: property/global moistPullOff (per type pair: pull_off_stress), and
// bondTensileStrength, bondShearStrength (scalar), all in Pa; and, where a crust is to form, a
// property/atom `crust_zone`: contacts of two spheres whose zone is not 0 become bonds.
//
// A bond is stored in the pair's contact history, so it moves with the rock from rank to rank and
// into restart files. Both ranks of a pair across a border compute the same sums: every term only
// changes its sign when the two spheres are swapped, so they agree to the bit.
#ifdef COHESION_MODEL
COHESION_MODEL(COHESION_MOIST, moist, 40)  // LIGGGHTS's own are below 16; 6 bits are available
#else
#ifndef COUPLER_DEM_MOIST_COHESION_MODEL_MOIST_H
#define COUPLER_DEM_MOIST_COHESION_MODEL_MOIST_H

#include <atom.h>
#include <contact_models.h>
#include <fix_property_atom.h>
#include <global_properties.h>
#include <modify.h>
#include <update.h>

#include "dem/moist/moist_law.hpp"

namespace LIGGGHTS {
namespace ContactModels {

template <>
class CohesionModel<COHESION_MOIST> : public CohesionModelBase {
  using Vector3d = dipper::dem::moist::Vector3d;

 public:
  CohesionModel(LAMMPS* l, IContactHistorySetup* history, ContactModelBase* model)
      : CohesionModelBase(l, history, model), is_wall_(model->is_wall()) {
    if (is_wall_) return;
    // "1": the value changes sign with the order of the two spheres.
    bond_ = pair_offset = history->add_history_value("bond_meff", "0");  // 0: no bond
    for (const char* name : {"bond_sx", "bond_sy", "bond_sz", "bond_tx", "bond_ty", "bond_tz"}) {
      history->add_history_value(name, "1");
    }
  }

  /// Where the history of the pairs has bond_meff, which is 0 without a bond.
  static inline int pair_offset = -1;

  void registerSettings(Settings&) override {}
  void postSettings(IContactHistorySetup*, ContactModelBase*) override {}
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) override {}
  void endSurfacesIntersect(SurfacesIntersectData&, ForceData&, ForceData&) override {}

  void connectToProperties(PropertyRegistry& registry) override {
    const char* me = "cohesion model moist";
    registry.registerProperty("moistPullOff", &pull_off_table);
    registry.registerProperty("bondTensileStrength", &tensile_strength);
    registry.registerProperty("bondShearStrength", &shear_strength);
    registry.registerProperty("k_n", &MODEL_PARAMS::createKn);
    registry.registerProperty("k_t", &MODEL_PARAMS::createKt);
    registry.registerProperty("gamman", &MODEL_PARAMS::createGamman);
    registry.registerProperty("gammat", &MODEL_PARAMS::createGammat);
    registry.connect("moistPullOff", pull_off_, me);
    registry.connect("bondTensileStrength", tensile_strength_, me);
    registry.connect("bondShearStrength", shear_strength_, me);
    registry.connect("k_n", kn_, me);
    registry.connect("k_t", kt_, me);
    registry.connect("gamman", gamman_, me);
    registry.connect("gammat", gammat_, me);
    zone_ = static_cast<FixPropertyAtom*>(
        modify->find_fix_property("crust_zone", "property/atom", "scalar", 0, 0, me, false));
  }

  void surfacesIntersect(SurfacesIntersectData& s, ForceData& i, ForceData& j) override {
    if (s.contact_flags) *s.contact_flags |= CONTACT_COHESION_MODEL;
    const double d = is_wall_ ? 2 * s.radi : dipper::dem::moist::pair_diameter(s.radi, s.radj);
    const Vector3d n(s.en[0], s.en[1], s.en[2]);
    add(-pull_off_[s.itype][s.jtype] * d * d * s.area_ratio * n, i, j);
    if (is_wall_) return;
    double* const bond = s.contact_history + bond_;
    if (zone_ && zone_->vector_atom[s.i] != 0 && zone_->vector_atom[s.j] != 0 && bond[0] == 0) {
      std::fill_n(bond, 7, 0.0);
      bond[0] = s.meff;
    }
    if (bond[0] != 0) load_bond(s, n, s.deltan, i, j);
  }

  void surfacesClose(SurfacesCloseData& s, ForceData& i, ForceData& j) override {
    if (is_wall_) return;  // the walls' pull ends at separation
    const double r = std::sqrt(s.rsq), gap = r - s.radsum;
    const Vector3d n = Vector3d(s.delta[0], s.delta[1], s.delta[2]) / r;
    const double d = dipper::dem::moist::pair_diameter(s.radi, s.radj);
    const double pull = dipper::dem::moist::moist_pull(pull_off_[s.itype][s.jtype] * d * d, gap,
                                                       dipper::dem::moist::kReach * s.radsum);
    add(-pull * n, i, j);
    s.has_force_update = true;
    double* const bond = s.contact_history + bond_;
    if (bond[0] != 0) {
      // The pair loop sets these for touching spheres only.
      s.omega_i = atom->omega[s.i];
      s.omega_j = atom->omega[s.j];
      load_bond(s, n, -gap, i, j);
    }
    // History, and with it the bond, is kept for pairs with a flag.
    if (s.contact_flags && bond[0] == 0) *s.contact_flags &= ~CONTACT_COHESION_MODEL;
  }

 private:
  static MatrixProperty* pull_off_table(PropertyRegistry& r, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(r, "moistPullOff", caller);
  }
  static ScalarProperty* tensile_strength(PropertyRegistry& r, const char* caller, bool) {
    return MODEL_PARAMS::createScalarProperty(r, "bondTensileStrength", caller);
  }
  static ScalarProperty* shear_strength(PropertyRegistry& r, const char* caller, bool) {
    return MODEL_PARAMS::createScalarProperty(r, "bondShearStrength", caller);
  }

  static void add(const Vector3d& F, ForceData& i, ForceData& j) {
    for (int k = 0; k < 3; ++k) {
      i.delta_F[k] += F[k];
      j.delta_F[k] -= F[k];
    }
  }

  void load_bond(const SurfacesCloseData& s, const Vector3d& n, double overlap, ForceData& i,
                 ForceData& j) {
    using Map = Eigen::Map<const Vector3d>;
    double* const bond = s.contact_history + bond_;
    const double ri = s.radi - 0.5 * overlap, rj = s.radj - 0.5 * overlap;
    const Vector3d v = Map(s.v_i) - Map(s.v_j), w_i = Map(s.omega_i), w_j = Map(s.omega_j);
    const Vector3d at_disc = v - (ri * w_i + rj * w_j).cross(n);
    const Vector3d v_t = at_disc - at_disc.dot(n) * n, w = w_i - w_j;
    Eigen::Map<Vector3d> shear(bond + 1), turn(bond + 4);
    if (s.computeflag && s.shearupdate) {
      shear += v_t * update->dt;
      shear -= shear.dot(n) * n;  // stays in the turning plane of the disc
      turn += w * update->dt;
    }
    const dipper::dem::moist::Bond disc{std::min(s.radi, s.radj), kn_[s.itype][s.jtype],
                                        kt_[s.itype][s.jtype]};
    const dipper::dem::moist::Strain strain{-overlap, shear, turn};
    const auto stress = dipper::dem::moist::bond_stress(disc, strain, n);
    if (stress.tensile_Pa >= tensile_strength_ || stress.shear_Pa >= shear_strength_) {
      std::fill_n(bond, 7, 0.0);  // permanently
      return;
    }
    auto load = dipper::dem::moist::bond_load(disc, strain, n);
    // Damped like the contact, and only while the spheres do not touch. (Both together would be
    // unstable at this step: an explicit damper needs c dt/m well below 1.) A rotation is damped by
    // the motion of the disc's rim.
    const double c_n = bond[0] * gamman_[s.itype][s.jtype], lever = disc.radius_m / 2;
    const double c_t = bond[0] * gammat_[s.itype][s.jtype];
    if (overlap < 0) load.force -= c_t * v_t + c_n * v.dot(n) * n;
    load.moment -= c_n * lever * lever * w;
    add(load.force, i, j);
    const Vector3d T_i = load.moment - ri * n.cross(load.force);
    const Vector3d T_j = -load.moment - rj * n.cross(load.force);
    for (int k = 0; k < 3; ++k) {
      i.delta_torque[k] += T_i[k];
      j.delta_torque[k] += T_j[k];
    }
  }

  bool is_wall_;
  int bond_ = 0;  ///< where the history has bond_meff; then shear_m and turn_rad
  double** pull_off_ = nullptr;
  double **kn_ = nullptr, **kt_ = nullptr, **gamman_ = nullptr, **gammat_ = nullptr;
  double tensile_strength_ = 0, shear_strength_ = 0;
  FixPropertyAtom* zone_ = nullptr;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS

#endif
#endif
