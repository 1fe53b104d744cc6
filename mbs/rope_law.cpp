#include "mbs/rope_law.hpp"

#include <algorithm>

namespace dipper::mbs {

RopeState RopeLaw::at(double path, double path_rate, const FreeLength& free) const {
  RopeState r{};
  r.stretch = path - free.length;
  r.stretch_rate = path_rate - free.rate;
  if (r.stretch <= 0) return r;
  const double elastic = axial_stiffness / (elastic_fraction * free.length) * r.stretch;
  r.tension = std::max(0.0, elastic + damping * r.stretch_rate);
  r.elastic_energy = 0.5 * elastic * r.stretch;
  r.dissipation = (r.tension - elastic) * r.stretch_rate;
  r.winch_pull = r.tension + 0.5 * elastic * r.stretch / free.length;
  r.winch_power = -r.winch_pull * free.rate;
  return r;
}

}  // namespace dipper::mbs
