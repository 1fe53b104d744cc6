#include "dem/fast/pair_forces.hpp"

#include <atom.h>
#include <comm.h>
#include <error.h>
#include <fix_insert_stream.h>
#include <fix_mesh_surface.h>
#include <force.h>
#include <global_properties.h>
#include <lammps.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <tri_mesh.h>
#include <update.h>
#include <vector_liggghts.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

#include "dem/fast/close_pairs.hpp"
#include "dem/rest_group.hpp"

// These need the headers above.
#include <contact_models.h>
#include <pair_gran_base.h>

namespace dipper::dem {
namespace {

using namespace LIGGGHTS::ContactModels;

using Style =
    GranStyle<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2, SURFACE_DEFAULT>;
using Model = ContactModel<Style>;

/// Of two types of rock.
struct Law {
  double kn, kt, gamma_n, gamma_t, friction, rolling;
};

/// The data of a sphere that its contacts read, contiguous in memory.
struct alignas(32) Sphere {
  double x[3], radius, v[3], mass, omega[3];
  int type;
};

/// The input of a step's loop.
struct Pass {
  const LAMMPS_NS::Atom& atom;
  const Sphere* spheres;
  const LAMMPS_NS::NeighList& contacts;  ///< history: shear [m], rolling torque [N m], ...
  const std::vector<Law>& laws;          ///< by type and type
  int types, width;                      ///< numbers a contact in the history
  double dt;
  bool limit, remember;  ///< no pull; history goes on

  double* history(const ClosePair& pair) const {
    return contacts.firstdouble[pair.i] + static_cast<std::ptrdiff_t>(width) * pair.n;
  }
  /// Prefetches the data of a later pair.
  void fetch(const ClosePair& pair) const {
    const Sphere* other = spheres + pair.j;
    __builtin_prefetch(other->x);
    __builtin_prefetch(&other->type);
    __builtin_prefetch(history(pair), 1);
  }
};

constexpr int kTouching = CONTACT_NORMAL_MODEL | CONTACT_TANGENTIAL_MODEL | CONTACT_ROLLING_MODEL;
constexpr int kBatch = 64;
constexpr double kCloseness = 0.125;  ///< of the skin
constexpr std::size_t kAhead = 32;  ///< pairs ahead: as many as are computed during a memory access

/// A batch of contacts of spheres i and j, one array per number, for vector instructions; vectors
/// as x, y and z. Most of the time is spent waiting for memory, so loads are made together, apart
/// from the sums.
struct Batch {
  int n = 0;
  int i[kBatch], j[kBatch];
  double* history[kBatch];
  double mi[kBatch], mj[kBatch], ri[kBatch], rj[kBatch];
  double kn[kBatch], kt[kBatch], gamma_n[kBatch], gamma_t[kBatch], friction[kBatch],
      rolling[kBatch];
  double d[3][kBatch];  ///< from j to i
  double v[3][kBatch];  ///< of i against j
  double wi[3][kBatch], wj[3][kBatch];
  double shear[3][kBatch], roll[3][kBatch];
  double F[3][kBatch], Ti[3][kBatch], Tj[3][kBatch];  ///< out: on i (-F is on j)

  void load(const Pass& p);
  void compute(double dt, bool limit, bool remember);
  void store(const Pass& p);
};

void Batch::load(const Pass& p) {
  for (int c = 0; c < n; ++c) {
    const Sphere &a = p.spheres[i[c]], &b = p.spheres[j[c]];
    const Law& law = p.laws[static_cast<std::size_t>(a.type) * p.types + b.type];
    mi[c] = a.mass;
    mj[c] = b.mass;
    ri[c] = a.radius;
    rj[c] = b.radius;
    kn[c] = law.kn;
    kt[c] = law.kt;
    gamma_n[c] = law.gamma_n;
    gamma_t[c] = law.gamma_t;
    friction[c] = law.friction;
    rolling[c] = law.rolling;
    for (int k = 0; k < 3; ++k) {
      d[k][c] = a.x[k] - b.x[k];
      v[k][c] = a.v[k] - b.v[k];
      wi[k][c] = a.omega[k];
      wj[k][c] = b.omega[k];
      shear[k][c] = history[c][k];
      roll[k][c] = history[c][3 + k];
    }
  }
}

/// LIGGGHTS's sums in its order (surface_model_default.h, normal_model_hooke_stiffness.h,
/// tangential_model_history.h, rolling_model_epsd2.h), without options that the decks never use.
__attribute__((target_clones("default", "avx2", "avx512f"))) void Batch::compute(double dt,
                                                                                 bool limit,
                                                                                 bool remember) {
  const double remembered = remember ? 1 : 0;
#ifndef __clang__
#pragma GCC ivdep
#endif
  for (int c = 0; c < kBatch; ++c) {
    const double dx = d[0][c], dy = d[1][c], dz = d[2][c];
    const double r = std::sqrt(dx * dx + dy * dy + dz * dz), rinv = 1.0 / r;
    const double ex = dx * rinv, ey = dy * rinv, ez = dz * rinv;
    const double meff = mi[c] * mj[c] / (mi[c] + mj[c]);

    // Relative motion: along the normal, and of the surfaces.
    const double vx = v[0][c], vy = v[1][c], vz = v[2][c];
    const double vn = vx * ex + vy * ey + vz * ez;
    const double overlap = ri[c] + rj[c] - r;
    const double ci = ri[c] - 0.5 * overlap, cj = rj[c] - 0.5 * overlap;  // arms
    const double wx = (ci * wi[0][c] + cj * wj[0][c]) * rinv;
    const double wy = (ci * wi[1][c] + cj * wj[1][c]) * rinv;
    const double wz = (ci * wi[2][c] + cj * wj[2][c]) * rinv;
    const double tx = vx - vn * ex - (dz * wy - dy * wz);
    const double ty = vy - vn * ey - (dx * wz - dz * wx);
    const double tz = vz - vn * ez - (dy * wx - dx * wy);

    double Fn = -(meff * gamma_n[c]) * vn + kn[c] * overlap;
    Fn = limit && Fn < 0 ? 0.0 : Fn;

    double sx = shear[0][c], sy = shear[1][c], sz = shear[2][c];
    const double gx = sx + tx * dt, gy = sy + ty * dt, gz = sz + tz * dt;
    const double along = gx * ex + gy * ey + gz * ez;
    sx = remembered > 0 ? gx - along * ex : sx;
    sy = remembered > 0 ? gy - along * ey : sy;
    sz = remembered > 0 ? gz - along * ez : sz;
    const double sticks = kt[c] * std::sqrt(sx * sx + sy * sy + sz * sz);
    const double slips = friction[c] * std::fabs(Fn);
    const bool slides = sticks > slips;
    const double ratio = slips / sticks, gamma = meff * gamma_t[c];
    double Fx = -(kt[c] * sx), Fy = -(kt[c] * sy), Fz = -(kt[c] * sz);
    Fx = slides ? Fx * ratio : Fx;
    Fy = slides ? Fy * ratio : Fy;
    Fz = slides ? Fz * ratio : Fz;
    shear[0][c] = slides ? -Fx / kt[c] : sx;
    shear[1][c] = slides ? -Fy / kt[c] : sy;
    shear[2][c] = slides ? -Fz / kt[c] : sz;
    Fx = slides ? Fx : Fx - gamma * tx;
    Fy = slides ? Fy : Fy - gamma * ty;
    Fz = slides ? Fz : Fz - gamma * tz;

    // Rolling friction: a spring with a limit, without spin about the normal.
    const double reff = ri[c] * rj[c] / (ri[c] + rj[c]);
    const double px = wi[0][c] - wj[0][c], py = wi[1][c] - wj[1][c], pz = wi[2][c] - wj[2][c];
    const double twist = px * ex + py * ey + pz * ez;
    const double k_roll = dt * (kt[c] * reff * reff);
    double qx = roll[0][c] + (px - ex * twist) * k_roll;
    double qy = roll[1][c] + (py - ey * twist) * k_roll;
    double qz = roll[2][c] + (pz - ez * twist) * k_roll;
    const double size = std::sqrt(qx * qx + qy * qy + qz * qz);
    const double most = std::fabs(Fn) * reff * rolling[c], share = most / size;
    qx = size > most ? qx * share : qx;
    qy = size > most ? qy * share : qy;
    qz = size > most ? qz * share : qz;
    roll[0][c] = qx;
    roll[1][c] = qy;
    roll[2][c] = qz;

    const double mx = ey * Fz - ez * Fy, my = ez * Fx - ex * Fz, mz = ex * Fy - ey * Fx;
    F[0][c] = Fn * ex + Fx;
    F[1][c] = Fn * ey + Fy;
    F[2][c] = Fn * ez + Fz;
    Ti[0][c] = -ci * mx - qx;
    Ti[1][c] = -ci * my - qy;
    Ti[2][c] = -ci * mz - qz;
    Tj[0][c] = -cj * mx + qx;
    Tj[1][c] = -cj * my + qy;
    Tj[2][c] = -cj * mz + qz;
  }
}

void Batch::store(const Pass& p) {
  for (int c = 0; c < n; ++c) {
    double *f = p.atom.f[0] + 3 * i[c], *torque = p.atom.torque[0] + 3 * i[c];
    for (int k = 0; k < 3; ++k) {
      f[k] += F[k][c];
      torque[k] += Ti[k][c];
      if (!p.remember) continue;
      history[c][k] = shear[k][c];
      history[c][3 + k] = roll[k][c];
    }
    if (j[c] >= p.atom.nlocal) continue;
    f = p.atom.f[0] + 3 * j[c];
    torque = p.atom.torque[0] + 3 * j[c];
    for (int k = 0; k < 3; ++k) {
      f[k] -= F[k][c];
      torque[k] += Tj[k][c];
    }
  }
  n = 0;
}

/// Updates the spheres that move; all of them when lists are `renewed`: which spheres rest (mask
/// bit `resting`) changes only then.
class Gathered {
 public:
  const Sphere* now(const LAMMPS_NS::Atom& atom, bool renewed, int resting) {
    if (renewed) begin(atom, resting);
    for (const int i : moving_) take(atom, i);
    return spheres_.data();
  }

 private:
  void begin(const LAMMPS_NS::Atom& atom, int resting) {
    const int all = atom.nlocal + atom.nghost;
    spheres_.resize(static_cast<std::size_t>(all));
    moving_.clear();
    for (int i = 0; i < all; ++i) {
      Sphere& s = spheres_[static_cast<std::size_t>(i)];
      s.radius = atom.radius[i];
      s.mass = atom.rmass[i];
      s.type = atom.type[i];
      if ((atom.mask[i] & resting) == 0)
        moving_.push_back(i);
      else
        take(atom, i);
    }
  }

  void take(const LAMMPS_NS::Atom& atom, int i) {
    Sphere& s = spheres_[static_cast<std::size_t>(i)];
    const double *x = atom.x[0] + 3 * i, *v = atom.v[0] + 3 * i, *omega = atom.omega[0] + 3 * i;
    for (int k = 0; k < 3; ++k) {
      s.x[k] = x[k];
      s.v[k] = v[k];
      s.omega[k] = omega[k];
    }
  }

  std::vector<Sphere> spheres_;  ///< ghosts too
  std::vector<int> moving_;
};

void add_forces(const Pass& p, const std::vector<ClosePair>& pairs) {
  static Batch batch;  // earlier contacts fill up the last batch
  const auto flush = [&] {
    batch.load(p);
    batch.compute(p.dt, p.limit, p.remember);
    batch.store(p);
  };
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (k + kAhead < pairs.size()) p.fetch(pairs[k + kAhead]);
    const ClosePair& pair = pairs[k];
    const auto [i, j, n] = pair;
    const Sphere &a = p.spheres[i], &b = p.spheres[j];
    const double dx = a.x[0] - b.x[0], dy = a.x[1] - b.x[1], dz = a.x[2] - b.x[2];
    const double sum = a.radius + b.radius;
    int& touched = p.contacts.firstneigh[i][n];
    double* const history = p.history(pair);
    if (dx * dx + dy * dy + dz * dz >= sum * sum) {
      // A pair that has separated starts without history when it touches again. LIGGGHTS keeps the
      // history unless the lists were built in between (docs/reliability.md#resuming-a-run).
      if (touched != 0) std::fill_n(history, p.width, 0.0);
      touched = 0;
      continue;
    }
    const int c = batch.n++;
    batch.i[c] = i;
    batch.j[c] = j;
    batch.history[c] = history;
    __builtin_prefetch(p.atom.f[0] + 3 * static_cast<std::ptrdiff_t>(j), 1);
    __builtin_prefetch(p.atom.torque[0] + 3 * static_cast<std::ptrdiff_t>(j), 1);
    touched |= kTouching;
    if (batch.n == kBatch) flush();
  }
  if (batch.n > 0) flush();
}

class PairForces final : public LIGGGHTS::PairStyles::Granular<Model> {
 public:
  PairForces(LAMMPS_NS::LAMMPS* l, LAMMPS_NS::PairGran* parent, std::int64_t hash)
      : Granular(l, parent, hash), lmp_(*l) {}

  void settings(int n, char** args, LIGGGHTS::IContactHistorySetup* history) override {
    Granular::settings(n, args, history);
    plain_ = true;
    for (int k = 0; k + 1 < n; k += 2) {
      const std::string word = args[k];
      const bool on = std::string(args[k + 1]) == "on";
      if (word == "limitForce")
        limit_ = on;
      else
        plain_ = false;
    }
  }

  void init_granular() override {
    Granular::init_granular();
    if (plain_) read_laws();
  }

  void compute_force(LAMMPS_NS::PairGran* pair, int energy, int virial, int add) override {
    const bool known = plain_ && energy == 0 && virial == 0 && add == 0 &&
                       pair->computeflag() != 0 && pair->freeze_group_bit() == 0 &&
                       !pair->storeContactForces() && !pair->storeContactForcesStress() &&
                       !pair->storeSumDelta() && !pair->store_sum_normal_force() &&
                       pair->fr_pair() == nullptr &&
                       lmp_.modify->n_fixes_style("insert/stream/predefined") == 0 &&
                       lmp_.modify->n_fixes_style("relax") == 0;
    if (!known) return Granular::compute_force(pair, energy, virial, add);
    pair->evflag = pair->vflag_fdotr = 0;
    const LAMMPS_NS::Neighbor& lists = *lmp_.neighbor;
    if (lists.ago == 0)
      resting_ = rest_bit(lmp_);  // resting spheres change only when lists are built
    const Sphere* spheres = gathered_.now(*lmp_.atom, lists.ago == 0, resting_);
    add_forces({*lmp_.atom, spheres, *pair->listgranhistory, laws_, types_, pair->dnum(),
                lmp_.update->dt, limit_, pair->shearupdate() != 0},
               close_.now(*lmp_.atom, *pair->list, *pair->listgranhistory, lists.skin * kCloseness,
                          lists.ago == 0, resting_));
  }

 private:
  void read_laws() {
    const int n = types_ = lmp_.force->registry.max_type() + 1;  // the tables' own length
    laws_.assign(static_cast<std::size_t>(n) * n, Law{});
    const auto read = [&](const char* name, double**& table, double Law::*to) {
      lmp_.force->registry.connect(name, table, "pair forces");
      for (int i = 1; i < n; ++i)
        for (int j = 1; j < n; ++j) laws_[static_cast<std::size_t>(i) * n + j].*to = table[i][j];
    };
    read("k_n", tables_[0], &Law::kn);
    read("k_t", tables_[1], &Law::kt);
    read("gamman", tables_[2], &Law::gamma_n);
    read("gammat", tables_[3], &Law::gamma_t);
    read("coeffFrict", tables_[4], &Law::friction);
    read("coeffRollFrict", tables_[5], &Law::rolling);
  }

  LAMMPS_NS::LAMMPS& lmp_;
  bool plain_ = false;  ///< no settings but those of the decks
  bool limit_ = false;
  int types_ = 0;
  int resting_ = 0;          ///< mask bit of kRestGroup; 0: no such group
  double** tables_[6] = {};  ///< LIGGGHTS's
  std::vector<Law> laws_;
  Gathered gathered_;
  ClosePairs close_;
};

LIGGGHTS::PairStyles::IGranularPairStyle* make_pair(LAMMPS_NS::LAMMPS* lmp,
                                                    LAMMPS_NS::PairGran* parent,
                                                    std::int64_t hash) {
  return new PairForces(lmp, parent, hash);
}

}  // namespace

void register_pair_forces() {
  // LIGGGHTS prints a message when a style is replaced.
  std::streambuf* const terminal = std::cerr.rdbuf(nullptr);
  LIGGGHTS::PairStyles::Factory::instance().addStyle("gran", static_cast<int>(Style::HASHCODE),
                                                     &make_pair);
  std::cerr.rdbuf(terminal);
}

}  // namespace dipper::dem
