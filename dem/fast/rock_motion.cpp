#include "dem/fast/rock_motion.hpp"

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <fix_gravity.h>
#include <fix_multisphere.h>
#include <fix_nve_sphere.h>
#include <force.h>
#include <lammps.h>
#include <math_extra.h>
#include <modify.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dipper::dem {
namespace {

using LAMMPS_NS::FixMultisphere;
using Vectors = LAMMPS_NS::VectorContainer<double, 3>;
using Quaternions = LAMMPS_NS::VectorContainer<double, 4>;
using Scalars = LAMMPS_NS::ScalarContainer<double>;
using Flags = LAMMPS_NS::VectorContainer<bool, 3>;

constexpr double kInertia = 0.4;  // of a sphere, over m r^2

/// Protected members of LIGGGHTS.
struct OpenMultisphere : FixMultisphere {
  static constexpr auto displace = &OpenMultisphere::displace_;
  static constexpr auto forward = &OpenMultisphere::fw_comm_flag_;
  static constexpr auto reverse = &OpenMultisphere::rev_comm_flag_;
};

/// The one fix of the style, or null when there is none or more than one.
LAMMPS_NS::Fix* only(LAMMPS_NS::Modify& modify, const char* style) {
  LAMMPS_NS::Fix* found = nullptr;
  for (int k = 0; k < modify.nfix; ++k) {
    if (std::strcmp(modify.fix[k]->style, style) != 0) continue;
    if (found != nullptr) return nullptr;
    found = modify.fix[k];
  }
  return found;
}

void unlist(LAMMPS_NS::Modify& modify, const LAMMPS_NS::Fix* fix, int stages) {
  const auto slot = std::find(modify.fix, modify.fix + modify.nfix, fix) - modify.fix;
  modify.fmask[slot] = modify.fix[slot]->setmask() & ~stages;
}

double square(const double* v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

}  // namespace

bool RockMotion::take_over() {
  LAMMPS_NS::Modify& modify = *lmp_.modify;
  const LAMMPS_NS::Domain& domain = *lmp_.domain;
  fix_spheres_ = only(modify, "nve/sphere");
  fix_bodies_ = static_cast<FixMultisphere*>(only(modify, "multisphere"));
  fix_gravity_ = static_cast<LAMMPS_NS::FixGravity*>(only(modify, "gravity"));
  int integrators = 0;
  for (int k = 0; k < modify.nfix; ++k) integrators += modify.fix[k]->time_integrate;
  const bool known = fix_spheres_ != nullptr && fix_bodies_ != nullptr && fix_gravity_ != nullptr &&
                     integrators == 1 &&
                     domain.xperiodic + domain.yperiodic + domain.zperiodic == 0 &&
                     domain.dimension == 3 && modify.n_fixes_style("insert/stream") == 0 &&
                     modify.n_fixes_style("relax") == 0 && modify.n_fixes_style("heat/gran") == 0;
  if (!known) return false;
  using namespace LAMMPS_NS::FixConst;
  unlist(modify, fix_spheres_, INITIAL_INTEGRATE | FINAL_INTEGRATE);
  unlist(modify, fix_bodies_, INITIAL_INTEGRATE | PRE_FINAL_INTEGRATE | FINAL_INTEGRATE);
  unlist(modify, fix_gravity_, POST_FORCE);
  return true;
}

void RockMotion::gather() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  const double dtf = 0.5 * lmp_.update->dt * lmp_.force->ftm2v, dtf_rotate = dtf / kInertia;
  fix_gravity_->get_gravity(g_);
  auto& data = fix_bodies_->data();
  auto& of = data.prop();
  const auto vectors = [&](const char* name) {
    return of.getElementProperty<Vectors>(name)->begin();
  };
  bodies_ = {data.n_body(),
             vectors("xcm"),
             vectors("vcm"),
             vectors("fcm"),
             vectors("torque"),
             vectors("angmom"),
             vectors("omega"),
             of.getElementProperty<Quaternions>("quat")->begin(),
             vectors("inertia"),
             vectors("ex_space"),
             vectors("ey_space"),
             vectors("ez_space"),
             of.getElementProperty<Scalars>("masstotal")->begin(),
             of.getElementProperty<Flags>("fflag")->begin(),
             of.getElementProperty<Flags>("tflag")->begin()};

  free_.clear();
  held_.clear();
  first_.assign(static_cast<std::size_t>(bodies_.n) + 1, 0);
  const int all = atom.nlocal + atom.nghost;
  std::vector<int> body(static_cast<std::size_t>(all), -1);  // on this rank
  for (int i = 0; i < all; ++i) {
    const int tag = fix_bodies_->belongs_to(i);
    if (tag >= 0) {
      body[i] = data.map(tag);
      if (body[i] >= 0) ++first_[static_cast<std::size_t>(body[i]) + 1];
    } else if (i < atom.nlocal) {
      const double m = atom.rmass[i], r = atom.radius[i];
      if ((atom.mask[i] & fix_spheres_->groupbit) != 0)
        free_.push_back({i, dtf / m, dtf_rotate / (r * r * m)});
      else
        held_.push_back(i);
    }
  }
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  of_body_.resize(static_cast<std::size_t>(first_.back()));
  place_.resize(3 * of_body_.size());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  double* const* const displace = fix_bodies_->*OpenMultisphere::displace;
  for (int i = 0; i < all; ++i) {
    if (body[i] < 0) continue;
    const int k = next[body[i]]++;
    of_body_[k] = i;
    std::copy_n(displace[i], 3, &place_[3 * static_cast<std::size_t>(k)]);
  }
  own_border_ = lmp_.comm->nprocs > 1 && border_.renew(*fix_bodies_);
}

bool RockMotion::held(int b) const {
  const bool *f = bodies_.moves[b], *t = bodies_.turns[b];
  return !(f[0] || f[1] || f[2] || t[0] || t[1] || t[2]) && square(bodies_.v[b]) == 0 &&
         square(bodies_.angmom[b]) == 0;
}

double RockMotion::initial_integrate() {
  const double fastest = std::sqrt(std::max(move_spheres(), move_bodies()));
  kick_due_ = false;
  if (own_border_) {
    border_.return_moved_spheres();
  } else if (lmp_.comm->nprocs > 1) {  // spheres of this rank's bodies that are on another rank
    fix_bodies_->*OpenMultisphere::reverse = LAMMPS_NS::MS_COMM_REV_X_V_OMEGA;
    fix_bodies_->reverse_comm();
  }
  return fastest;
}

void RockMotion::forward() {
  own_border_ ? border_.forward_moved_spheres() : lmp_.comm->forward_comm();
}

double RockMotion::move_spheres() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  const double dt = lmp_.update->dt;
  double fastest = 0;
  for (const Sphere& s : free_) {
    if (kick_due_) kick_sphere(s);
    double *x = atom.x[s.index], *v = atom.v[s.index], *w = atom.omega[s.index];
    const double *f = atom.f[s.index], *torque = atom.torque[s.index];
    for (int k = 0; k < 3; ++k) {
      v[k] += s.dtf_m * f[k];
      x[k] += dt * v[k];
      w[k] += s.dtf_I * torque[k];
    }
    fastest = std::max(fastest, square(v));
  }
  return fastest;
}

double RockMotion::move_bodies() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  const double dt = lmp_.update->dt, dtf = 0.5 * dt * lmp_.force->ftm2v, dtq = 0.5 * dt;
  double fastest = 0;
  for (int b = 0; b < bodies_.n; ++b) {
    if (held(b)) continue;
    if (kick_due_) kick_body(b, false);
    double *xcm = bodies_.x[b], *vcm = bodies_.v[b], *w = bodies_.omega[b];
    double *ex = bodies_.ex[b], *ey = bodies_.ey[b], *ez = bodies_.ez[b];
    const double dtf_m = dtf / bodies_.mass[b];
    for (int k = 0; k < 3; ++k) {
      if (bodies_.moves[b][k]) vcm[k] += dtf_m * bodies_.force[b][k];
      xcm[k] += dt * vcm[k];
      if (bodies_.turns[b][k]) bodies_.angmom[b][k] += dtf * bodies_.torque[b][k];
    }
    MathExtra::angmom_to_omega(bodies_.angmom[b], ex, ey, ez, bodies_.inertia[b], w);
    MathExtra::richardson(bodies_.quat[b], bodies_.angmom[b], w, bodies_.inertia[b], dtq);
    MathExtra::q_to_exyz(bodies_.quat[b], ex, ey, ez);
    for (int k = first_[b]; k < first_[b + 1]; ++k) {
      const int i = of_body_[k];
      double *x = atom.x[i], *v = atom.v[i];
      MathExtra::matvec(ex, ey, ez, &place_[3 * static_cast<std::size_t>(k)], x);
      v[0] = w[1] * x[2] - w[2] * x[1] + vcm[0];
      v[1] = w[2] * x[0] - w[0] * x[2] + vcm[1];
      v[2] = w[0] * x[1] - w[1] * x[0] + vcm[2];
      for (int n = 0; n < 3; ++n) x[n] += xcm[n];
      std::copy_n(w, 3, atom.omega[i]);
      fastest = std::max(fastest, square(v));
    }
  }
  return fastest;
}

void RockMotion::final_integrate(bool seen) {
  const bool ranks = lmp_.comm->nprocs > 1;
  if (own_border_) {
    border_.forward_forces();
  } else if (ranks) {
    fix_bodies_->*OpenMultisphere::forward = LAMMPS_NS::MS_COMM_FW_F_TORQUE;
    fix_bodies_->forward_comm();
  }
  kick_due_ = !seen;
  if (!seen) return;
  kick(true);
  if (!ranks) return;
  if (own_border_) return border_.return_velocities();  // ghosts get theirs with the next step
  fix_bodies_->*OpenMultisphere::reverse = LAMMPS_NS::MS_COMM_REV_V_OMEGA;
  fix_bodies_->reverse_comm();
  fix_bodies_->*OpenMultisphere::forward = LAMMPS_NS::MS_COMM_FW_V_OMEGA;
  fix_bodies_->forward_comm();
}

void RockMotion::weigh(int i) {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  if ((atom.mask[i] & fix_gravity_->groupbit) == 0) return;
  for (int k = 0; k < 3; ++k) atom.f[i][k] += atom.rmass[i] * g_[k];
}

void RockMotion::kick(bool seen) {
  for (const Sphere& s : free_) kick_sphere(s);
  if (seen)
    for (const int i : held_) weigh(i);
  for (int b = 0; b < bodies_.n; ++b) kick_body(b, seen);
}

void RockMotion::kick_sphere(const Sphere& s) {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  weigh(s.index);
  double *v = atom.v[s.index], *w = atom.omega[s.index];
  const double *f = atom.f[s.index], *torque = atom.torque[s.index];
  for (int k = 0; k < 3; ++k) {
    v[k] += s.dtf_m * f[k];
    w[k] += s.dtf_I * torque[k];
  }
}

void RockMotion::kick_body(int b, bool seen) {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  const double dtf = 0.5 * lmp_.update->dt * lmp_.force->ftm2v;
  const bool rests = held(b);
  if (rests && !seen) return;
  const double* xcm = bodies_.x[b];
  double F[3], T[3];
  std::copy_n(bodies_.force[b], 3, F);
  std::copy_n(bodies_.torque[b], 3, T);
  for (int k = first_[b]; k < first_[b + 1]; ++k) {
    const int i = of_body_[k];
    const double *x = atom.x[i], *f = atom.f[i], *torque = atom.torque[i];
    const double d[3] = {x[0] - xcm[0], x[1] - xcm[1], x[2] - xcm[2]};
    for (int n = 0; n < 3; ++n) F[n] += f[n];
    T[0] += d[1] * f[2] - d[2] * f[1] + torque[0];
    T[1] += d[2] * f[0] - d[0] * f[2] + torque[1];
    T[2] += d[0] * f[1] - d[1] * f[0] + torque[2];
  }
  for (int n = 0; n < 3; ++n) F[n] += bodies_.mass[b] * g_[n];
  std::copy_n(F, 3, bodies_.force[b]);
  std::copy_n(T, 3, bodies_.torque[b]);
  if (rests) return;

  double *vcm = bodies_.v[b], *w = bodies_.omega[b];
  const double dtf_m = dtf / bodies_.mass[b];
  for (int n = 0; n < 3; ++n) {
    if (bodies_.moves[b][n]) vcm[n] += dtf_m * F[n];
    if (bodies_.turns[b][n]) bodies_.angmom[b][n] += dtf * T[n];
  }
  MathExtra::angmom_to_omega(bodies_.angmom[b], bodies_.ex[b], bodies_.ey[b], bodies_.ez[b],
                             bodies_.inertia[b], w);
  if (!seen) return;
  for (int k = first_[b]; k < first_[b + 1]; ++k) {
    const int i = of_body_[k];
    double d[3], *v = atom.v[i];
    MathExtra::matvec(bodies_.ex[b], bodies_.ey[b], bodies_.ez[b],
                      &place_[3 * static_cast<std::size_t>(k)], d);
    v[0] = w[1] * d[2] - w[2] * d[1] + vcm[0];
    v[1] = w[2] * d[0] - w[0] * d[2] + vcm[1];
    v[2] = w[0] * d[1] - w[1] * d[0] + vcm[2];
    std::copy_n(w, 3, atom.omega[i]);
  }
}

void RockMotion::finish() {
  if (kick_due_) kick(false);
  kick_due_ = false;
}

void RockMotion::library_initial_integrate(int vflag) {
  finish();
  fix_spheres_->initial_integrate(vflag);
  fix_bodies_->initial_integrate(vflag);
}

void RockMotion::library_final_integrate(int vflag) {
  fix_gravity_->post_force(vflag);
  fix_bodies_->pre_final_integrate();
  fix_spheres_->final_integrate();
  fix_bodies_->final_integrate();
}

}  // namespace dipper::dem
