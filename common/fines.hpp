// Rock with fines in its voids that move with it.
#pragma once

namespace dipper {

/// Fines fill the share phi of the voids e and are packed as densely as the rock: a density rho, of
/// solid rock or of the pile, becomes rho (1 + phi e).
inline double with_fines(double density_kg_m3, double fines_fraction, double porosity) {
  return density_kg_m3 * (1 + fines_fraction * porosity);
}

}  // namespace dipper
