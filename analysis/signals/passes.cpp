#include "analysis/signals/passes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/gravity.hpp"
#include "machine/door.hpp"

namespace dipper::analysis::signals {
namespace {

constexpr double kFirstContact_N = 20e3;  // the weight of a 2 t rock: more than a loose rock
constexpr double kDump_s = 1.0;           // a load needs longer to leave
constexpr double kLook_s = 0.5, kLeaving = 0.05;  // of the load: still under way at the end
constexpr double kStray_kg = 2000;                // of that rock: less is not a load

/// First contact has more force on the dipper than this; what has stuck in the dipper has none.
double contact_N(const PassSignals& s, std::size_t begin) {
  return kFirstContact_N + kGravity_m_s2 * s.dipper_mass_kg[begin];
}

Pass measure(const PassSignals& s, std::size_t begin, std::size_t dump, std::size_t end) {
  Pass p;
  std::size_t dig = begin;
  while (dig < dump && s.dipper_force_N[dig] < contact_N(s, begin)) ++dig;
  p.t_start_s = s.time_s[begin];
  p.t_dig_s = s.time_s[dig];
  p.t_dump_s = s.time_s[dump];
  p.t_end_s = s.time_s[end];
  const bool opens = dump > begin && machine::door_is_open(s.door_rad[dump]);
  std::size_t n = 0;
  for (std::size_t i = opens ? dump - 1 : dump; s.time_s[i] >= p.t_dump_s - kPayloadWindow_s; --i) {
    p.payload_kg += s.dipper_mass_kg[i];
    ++n;
    if (i == begin) break;
  }
  p.payload_kg /= static_cast<double>(n);
  p.truck_kg = s.truck_mass_kg[end] - s.truck_mass_kg[begin];
  double impulse = 0;  // time-weighted: sync steps may differ in length
  for (std::size_t i = dig; i < dump; ++i) {
    const double force = std::hypot(s.crowd_force_N[i], s.hoist_force_N[i]);
    impulse += force * (s.time_s[i + 1] - s.time_s[i]);
    if (force > p.dig_force_peak_N) {
      p.dig_force_peak_N = force;
      p.dig_force_peak_t_s = s.time_s[i];
    }
  }
  if (p.t_dump_s > p.t_dig_s) p.dig_force_mean_N = impulse / (p.t_dump_s - p.t_dig_s);
  return p;
}

/// A door that is open at the start has not opened: the first pass begins as it shuts.
std::size_t first_shut(const std::vector<double>& door_rad) {
  const auto shut = std::find_if_not(door_rad.begin(), door_rad.end(),
                                     [](double a) { return machine::door_is_open(a); });
  return static_cast<std::size_t>(shut - door_rad.begin());
}

/// Whether the run ends while the load leaves the dipper or arrives in the truck.
bool ends_in_dump(const PassSignals& s, const Pass& p) {
  const std::size_t last = s.time_s.size() - 1;
  if (!machine::door_is_open(s.door_rad[last]) || p.payload_kg <= 0) return false;
  if (s.time_s[last] - p.t_dump_s < kDump_s) return true;
  std::size_t from = last;
  while (from > 0 && s.time_s[last] - s.time_s[from] < kLook_s) --from;
  const double leaves_kg = s.dipper_mass_kg[from] - s.dipper_mass_kg[last],
               arrives_kg = s.truck_mass_kg[last] - s.truck_mass_kg[from];
  return std::max(leaves_kg, arrives_kg) > kLeaving * p.payload_kg;
}

}  // namespace

std::vector<Pass> find_passes(const PassSignals& s) {
  const std::size_t n = s.time_s.size();
  for (const auto* v : {&s.door_rad, &s.dipper_force_N, &s.hoist_force_N, &s.crowd_force_N,
                        &s.rope_tension_N, &s.dipper_mass_kg, &s.truck_mass_kg}) {
    if (v->size() != n) throw std::invalid_argument("pass signals of different lengths");
  }
  std::vector<Pass> passes;
  const auto open = [&](std::size_t i) { return machine::door_is_open(s.door_rad[i]); };
  std::size_t begin = first_shut(s.door_rad);
  while (begin + 1 < n) {
    std::size_t dump = begin;
    while (dump + 1 < n && !open(dump)) ++dump;
    std::size_t end = dump;
    while (end + 1 < n && open(end)) ++end;
    passes.push_back(measure(s, begin, dump, end));
    passes.back().pass = static_cast<int>(passes.size());
    passes.back().dumped = open(dump) && !(end + 1 >= n && ends_in_dump(s, passes.back()));
    // After the last dump comes the return. It is not a pass if the door stays closed and the
    // dipper does not dig, or touches rock but holds no load.
    const Pass& last = passes.back();
    const double* force_N = s.dipper_force_N.data();
    const bool dug = std::any_of(force_N + begin, force_N + dump + 1,
                                 [least = contact_N(s, begin)](double f) { return f >= least; });
    const bool empty = last.payload_kg - s.dipper_mass_kg[begin] < kStray_kg &&
                       std::abs(last.truck_kg) < kStray_kg;
    if (passes.size() > 1 && end + 1 >= n && !open(dump) && (!dug || empty)) {
      passes[passes.size() - 2].truck_kg += last.truck_kg;
      passes.pop_back();
      break;
    }
    begin = end;
  }
  return passes;
}

std::vector<PlannedPass> find_planned_passes(const std::vector<double>& time_s,
                                             const std::vector<double>& door_rad) {
  if (time_s.size() != door_rad.size())
    throw std::invalid_argument("times and the door's angles of different lengths");
  std::vector<PlannedPass> passes;
  std::size_t begin = first_shut(door_rad);
  for (std::size_t k = begin + 1; k < time_s.size(); ++k) {
    if (machine::door_is_open(door_rad[k]) || !machine::door_is_open(door_rad[k - 1])) continue;
    passes.push_back({time_s[begin], time_s[k]});
    begin = k;
  }
  if (begin < door_rad.size() && machine::door_is_open(door_rad.back()))
    passes.push_back({time_s[begin], time_s.back()});
  return passes;
}

}  // namespace dipper::analysis::signals
