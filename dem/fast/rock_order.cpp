#include "dem/fast/rock_order.hpp"

#include <atom.h>
#include <atom_vec.h>
#include <domain.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <neighbor.h>

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "dem/rest_group.hpp"

namespace dipper::dem {
namespace {

/// The lowest 21 bits of n, each followed by two zeros.
std::uint64_t spread(std::uint64_t n) {
  n &= 0x1fffff;
  n = (n | n << 32) & 0x1f00000000ffff;
  n = (n | n << 16) & 0x1f0000ff0000ff;
  n = (n | n << 8) & 0x100f00f00f00f00f;
  n = (n | n << 4) & 0x10c30c30c30c30c3;
  return (n | n << 2) & 0x1249249249249249;
}

/// Place on the curve: cells half as wide as lists reach.
class Curve {
 public:
  explicit Curve(LAMMPS_NS::LAMMPS& lmp)
      : lo_(lmp.domain->boxlo), per_m_(2 / lmp.neighbor->cutneighmax) {}
  std::uint64_t operator()(const double* x) const {
    std::uint64_t cell[3];
    for (int k = 0; k < 3; ++k)
      cell[k] = static_cast<std::uint64_t>(std::max(0.0, (x[k] - lo_[k]) * per_m_));
    return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
  }

 private:
  const double* lo_;
  double per_m_;
};

/// Moves the entry at order[k] to k, for all k: move(from, to), one entry at a time, through the
/// place `spare`.
template <typename Move>
void permute(const std::vector<int>& order, int spare, const Move& move) {
  std::vector<bool> done(order.size(), false);
  for (std::size_t begin = 0; begin < order.size(); ++begin) {
    if (done[begin] || order[begin] == static_cast<int>(begin)) continue;
    move(static_cast<int>(begin), spare);
    std::size_t to = begin;
    for (; order[to] != static_cast<int>(begin); to = order[to]) {
      move(order[to], static_cast<int>(to));
      done[to] = true;
    }
    move(spare, static_cast<int>(to));
    done[to] = true;
  }
}

template <typename Key>
std::vector<int> sorted(const std::vector<Key>& keys) {
  std::vector<int> order(keys.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });
  return order;
}

}  // namespace

void order_rock(LAMMPS_NS::LAMMPS& lmp, LAMMPS_NS::FixMultisphere& fix) {
  LAMMPS_NS::Atom& atom = *lmp.atom;
  auto& bodies = fix.data();
  const Curve curve(lmp);

  const int resting = rest_bit(lmp);
  using Key = std::tuple<bool, std::uint64_t, int, int>;  // rests, place, body, sphere
  std::vector<Key> of_body, of_sphere;
  for (int b = 0; b < bodies.n_body(); ++b) {
    double x[3];
    bodies.xcm(x, b);
    of_body.emplace_back(false, curve(x), bodies.tag(b), 0);
  }
  const auto body_of = [&](int i) {
    const int tag = fix.belongs_to(i);
    return tag < 0 ? -1 : bodies.map(tag);
  };
  for (int i = 0; i < atom.nlocal; ++i)
    if (const int b = body_of(i); b >= 0)
      std::get<bool>(of_body[b]) = (atom.mask[i] & resting) != 0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const int b = body_of(i);
    const bool rests = (atom.mask[i] & resting) != 0;
    const auto place = b < 0 ? curve(atom.x[i]) : std::get<std::uint64_t>(of_body[b]);
    of_sphere.emplace_back(rests, place, fix.belongs_to(i), atom.tag[i]);
  }

  bodies.prop().addUninitializedElement();
  const int spare = bodies.n_body();
  permute(sorted(of_body), spare, [&](int from, int to) { bodies.copy_body(from, to); });
  bodies.prop().deleteElement(spare);

  if (atom.nlocal == atom.nmax) atom.avec->grow(0);
  permute(sorted(of_sphere), atom.nlocal, [&](int from, int to) { atom.avec->copy(from, to, 0); });
}

}  // namespace dipper::dem
