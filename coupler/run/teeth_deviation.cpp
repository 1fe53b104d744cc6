#include "coupler/run/teeth_deviation.hpp"

#include <algorithm>
#include <cmath>

#include "common/angles.hpp"
#include "common/record/record.hpp"
#include "machine/kinematics.hpp"

namespace dipper::run {

double teeth_deviation(const std::filesystem::path& record, const cases::Case& c,
                       const analysis::signals::Phase& phase) {
  const machine::ShovelKinematics taut(machine::load_machine(c.machine.model), Pose{},
                                       radians(c.machine.rake_angle_deg));
  const auto time_s = record::read_channel(record, "time_s");
  const auto hoist = record::read_channel(record, "machine/hoist");
  const auto crowd = record::read_channel(record, "machine/crowd");
  const auto saddle = record::read_channel(record, "machine/saddle_pitch");
  double most = 0;
  for (std::size_t i = 0; i < saddle.size(); ++i) {
    if (time_s[i] < phase.t_start_s || time_s[i] > phase.t_end_s) continue;
    const double turn = saddle[i] - taut.saddle_angle(hoist[i], crowd[i]);
    most = std::max(most, std::abs(turn) * taut.teeth_reach(crowd[i]));
  }
  return most;
}

}  // namespace dipper::run
