#include "coupler/deck/stable_timestep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace dipper::deck {

double critical_step(double omega, double zeta) {
  return 2 * (std::sqrt(1 + zeta * zeta) - zeta) / omega;
}

double stable_timestep(const cases::Case& c) {
  const ContactTable t = contact_table(c);
  const double n = std::sqrt(static_cast<double>(kContacts));
  const cases::ContactCase k = cases::of_every_pair(c.contact);
  const double damping = std::max(k.normal_damping, k.normal_damping_other);
  double step = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < t.kn.size(); ++i)
    if (t.kn(i) > 0)
      step = std::min(step, critical_step(n * std::sqrt(t.kn(i) / t.meff_kg(i)), n * damping));
  return step;
}

double chosen_timestep(const cases::Case& c) {
  return std::stod(fmt::format("{:.1e}", 0.85 * stable_timestep(c)));
}

}  // namespace dipper::deck
