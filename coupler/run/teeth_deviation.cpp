#include "coupler/run/teeth_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"

namespace dipper::run {

TeethDeviation::TeethDeviation(const std::filesystem::path& record, const cases::Case& c)
    : taut_(machine::load_machine(c.machine.model), Pose{}, radians(c.machine.rake_angle_deg)),
      columns_(record) {
  for (const char* channel : {"time_s", "machine/hoist", "machine/crowd", "machine/saddle_pitch"})
    columns_.read(channel);
}

double TeethDeviation::most(const analysis::signals::Phase& phase) const {
  const auto time_s = columns_.get("time_s"), hoist = columns_.get("machine/hoist"),
             crowd = columns_.get("machine/crowd"), saddle = columns_.get("machine/saddle_pitch");
  double most = 0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] < phase.t_start_s || time_s[i] > phase.t_end_s) continue;
    const double turn = saddle[i] - taut_.saddle_angle(hoist[i], crowd[i]);
    most = std::max(most, std::abs(turn) * taut_.teeth_reach(crowd[i]));
  }
  return most;
}

}  // namespace dipper::run
