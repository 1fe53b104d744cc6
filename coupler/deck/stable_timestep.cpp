#include "coupler/deck/stable_timestep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "coupler/deck/rock_shape.hpp"

namespace dipper::deck {
namespace {

// Of contacts all around a sphere two thirds turn it about an axis; its inertia is 0.4 m r^2.
constexpr double kTurned = 2.0 / 3, kInertia = 0.4;

}  // namespace

double critical_step(double omega, double zeta) {
  return 2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega;
}

double stable_timestep(const cases::Case& c) {
  const ContactTable t = contact_table(c);
  const double n = std::sqrt(static_cast<double>(kContacts));
  const cases::ContactCase k = cases::of_every_pair(c.contact);
  const double damping = std::max(k.normal_damping, *k.normal_damping_other);
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < t.kn.size(); ++i) {
    if (t.kn(i) <= 0) continue;
    step = std::min(step, critical_step(n * std::sqrt(t.kn(i) / t.meff_kg(i)), n * damping));
    if (t.friction(i) <= 0) continue;
    const double turns = std::sqrt(kContacts * kTurned / kInertia);
    const double omega = std::sqrt(t.kt(i) / t.meff_kg(i));
    step = std::min(step, critical_step(turns * omega, turns * t.gammat(i) / (2 * omega)));
  }
  return step;
}

double pressed_timestep(const cases::Case& c) {
  const ContactTable t = contact_table(c);
  const std::vector<RockClass> rocks = rock_classes(c);
  const double damping = *cases::of_every_pair(c.contact).normal_damping_other;
  const double n = std::sqrt(2.0 * spheres_a_rock(c.rock.shape_resolution));
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    if (rocks[i].is_sphere) continue;
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Index wall = atom_types(c).dipper() - 1;
    const double omega = std::sqrt(t.kn(row, wall) / t.meff_kg(row, wall));
    step = std::min(step, critical_step(n * omega, n * damping));
  }
  return step;
}

double chosen_timestep(const cases::Case& c) {
  return std::stod(fmt::format("{:.1e}", 0.85 * stable_timestep(c)));
}

}  // namespace dipper::deck
