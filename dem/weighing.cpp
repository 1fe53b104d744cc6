#include "dem/weighing.hpp"

#include <atom.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <modify.h>
#include <mpi.h>

#include <algorithm>

#include "dem/holding.hpp"

namespace dipper::dem {
namespace {

/// Calls visit(position, velocity, mass) for every single sphere and every multisphere of this
/// rank.
template <typename Visit>
void for_each_mass(LAMMPS_NS::LAMMPS& lmp, const Visit& visit) {
  auto* fix = lmp.modify->find_fix_style("multisphere", 0);
  auto* rocks = static_cast<LAMMPS_NS::FixMultisphere*>(fix);
  const LAMMPS_NS::Atom* atom = lmp.atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (rocks == nullptr || rocks->belongs_to(i) < 0) visit(atom->x[i], atom->v[i], atom->rmass[i]);
  }
  if (rocks == nullptr) return;
  auto& data = rocks->data();
  for (int b = 0; b < data.n_body(); ++b) {
    double x[3], v[3];
    data.xcm(x, b);
    data.vcm(v, b);
    visit(x, v, data.mass(b));
  }
}

/// A box of the set-up at its present place. Most rock is far from every box: a sphere around each
/// box rejects it without a change of frame.
struct PlacedBox {
  PlacedBox(const setup::Scale& s, const Pose& X_WS)
      : X_SW(inverse(X_WS)),
        centre_W(X_WS * Vector3d((s.box.min_m + s.box.max_m) / 2)),
        square_m2(1.0001 * s.box.sides_m().squaredNorm() / 4),
        box(s.box) {}
  bool holds(const Vector3d& p_W) const {
    if ((p_W - centre_W).squaredNorm() > square_m2) return false;
    return box.holds(X_SW * p_W);
  }
  Pose X_SW;
  Vector3d centre_W;
  double square_m2;
  Box box;
};

}  // namespace

Weighing::Weighing(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup, const Holding* holding)
    : lmp_(lmp), holding_(holding), scales_(setup.scales) {
  for (const setup::Scale& s : scales_) {
    const auto body = std::find(setup.bodies.begin(), setup.bodies.end(), s.body);
    body_.push_back(static_cast<std::size_t>(body - setup.bodies.begin()));
  }
}

std::vector<core::Channel> Weighing::channels() const {
  std::vector<core::Channel> all;
  for (const setup::Scale& s : scales_) all.push_back({s.name, "kg", "-"});
  all.push_back({"rock_mass", "kg", "-"});
  all.push_back({"rock_kinetic_energy", "J", "-"});
  all.push_back({"rocks", "1", "-"});
  all.push_back({"particles", "1", "-"});
  return all;
}

void Weighing::measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const {
  const std::size_t n = scales_.size();
  std::vector<PlacedBox> boxes;
  for (std::size_t k = 0; k < n; ++k)
    boxes.emplace_back(scales_[k], body_[k] < X_WB.size() ? X_WB[body_[k]] : scales_[k].X_WS);
  std::vector<double> sums(n + 4, 0.0);
  const auto count = [&](const double* x, const double* v, double mass) {
    const Vector3d p_W = Eigen::Map<const Vector3d>(x);
    for (std::size_t k = 0; k < n; ++k)
      if (boxes[k].holds(p_W)) sums[k] += mass;
    sums[n] += mass;
    sums[n + 1] += 0.5 * mass * Eigen::Map<const Vector3d>(v).squaredNorm();
  };
  for_each_mass(lmp_, count);
  auto* fix = lmp_.modify->find_fix_style("multisphere", 0);
  if (auto* rocks = static_cast<LAMMPS_NS::FixMultisphere*>(fix))
    sums[n + 2] = rocks->data().n_body();
  sums[n + 3] = lmp_.atom->nlocal;
  if (holding_ != nullptr) {
    for (const ParkedRock::Mass& m : holding_->parked()) {
      const double still[3] = {0, 0, 0};
      count(m.p_W.data(), still, m.mass_kg);
      sums[n + 2] += m.packed.empty() ? 0 : 1;
    }
    sums[n + 3] += static_cast<double>(holding_->spheres_parked());
  }
  parts.insert(parts.end(), sums.begin(), sums.end());
}

double rock_mass(LAMMPS_NS::LAMMPS& lmp) {
  double sum = 0;
  for_each_mass(lmp, [&](const double*, const double*, double mass) { sum += mass; });
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, lmp.world);
  return sum;
}

}  // namespace dipper::dem
