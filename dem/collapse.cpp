#include "dem/collapse.hpp"

#include <comm.h>
#include <fmt/core.h>
#include <input.h>
#include <lammps.h>

#include <stdexcept>
#include <utility>

#include "dem/time_loop.hpp"
#include "dem/weighing.hpp"

namespace dipper::dem {

Collapse::Collapse(LAMMPS_NS::LAMMPS& lmp, setup::RockFall fall)
    : lmp_(lmp), fall_(std::move(fall)) {}

/// Depends on the step only, so that a resumed run knows whether the rock was added.
bool Collapse::needs_all_rock(const RockWindow& window) const {
  return window.first_step <= fall_.at_step && fall_.at_step < window.first_step + window.n_steps;
}

void Collapse::before_window(const RockWindow& window) {
  if (!needs_all_rock(window)) return;
  mass_before_kg_ = rock_mass(lmp_);
  lmp_.input->file(fall_.deck.c_str());
  set_up_time_loop(lmp_);
}

void Collapse::after_window(const RockWindow& window) {
  if (!needs_all_rock(window)) return;
  const double came = rock_mass(lmp_) - mass_before_kg_;
  if (lmp_.comm->me == 0)
    fmt::print("of {:.0f} kg of rock that come down, {:.0f} kg found room\n", fall_.mass_kg, came);
  if (came > 0.8 * fall_.mass_kg) return;
  throw std::runtime_error(
      fmt::format("of {:.0f} kg of rock that come down, {:.0f} kg found room; take a lower "
                  "collapse.height_m or a longer or wider bench",
                  fall_.mass_kg, came));
}

}  // namespace dipper::dem
