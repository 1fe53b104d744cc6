// Terms of the motion on which a drive's force may depend besides the rock, and force laws made of
// them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/phases.hpp"

namespace dipper::analysis::signals {

/// A force in kN: the sum of a coefficient times each term. Names are those of kDriveTerms.
using ForceLaw = std::map<std::string, double>;

/// The terms' names in files, with the unit of each:
///   constant         1
///   hoist_in, _out   1 while the ropes come in, run out (faster than 0.05 m/s), else 0
///   crowd_out, _in   1 while the crowd moves out, in (likewise)
///   swing            1 while the house swings (faster than 0.02 rad/s)
///   load             1 while a load is carried: from the start of breakout to that of dump
///   hoist_speed      m/s, of ropes that come in
///   crowd_speed      m/s, outward
///   hoist_length     m, the hoist's reading
///     crowd_extension  m, of the crowd from its innermost reading
///     crowd_drag       crowd_extension with the sign of the motion: negative while the crowd moves
///   in, 0 at rest
///   swing_angle      rad, the swing's reading
///   pass             number of the pass, from 1
inline constexpr std::array<const char*, 14> kDriveTerms = {"constant_kN",
                                                            "hoist_in_kN",
                                                            "hoist_out_kN",
                                                            "crowd_out_kN",
                                                            "crowd_in_kN",
                                                            "swing_kN",
                                                            "load_kN",
                                                            "hoist_speed_kNs_m",
                                                            "crowd_speed_kNs_m",
                                                            "hoist_length_kN_m",
                                                            "crowd_extension_kN_m",
                                                            "crowd_drag_kN_m",
                                                            "swing_angle_kN_rad",
                                                            "pass_kN"};

bool is_drive_term(const std::string& name);

/// The terms at each reading of time, hoist, crowd and swing; `passes` in order of time. A speed is
/// that between the previous and the next reading. Throws std::invalid_argument for signals of
/// different lengths, and as find_phases does.
std::vector<std::array<double, kDriveTerms.size()>> drive_terms(
    const DriveSignals& s, const std::vector<TimeSpan>& passes);

/// Force [kN] of a law at a reading's terms. Throws std::invalid_argument for an unknown term.
double force_kN(const ForceLaw& law, const std::array<double, kDriveTerms.size()>& terms);

}  // namespace dipper::analysis::signals
