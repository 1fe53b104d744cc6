// pile.profile: a scanned section in place of the keys of the trapezoid.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"

namespace dipper::cases {

/// The keys a profile replaces: a case has these or a profile.
inline const std::array<std::string, 4> kReplacedByProfile = {
    "pile.toe_x_m", "pile.height_m", "pile.crest_depth_m", "pile.face_angle_deg"};

/// True when the case has a profile, and therefore none of these keys.
bool is_replaced_by_profile(const Case& c, const std::string& key);

/// Reads the profile into `pile.outline_m`, if the case has one; every fault of the file, and every
/// key beside it that it replaces, becomes a finding.
void read_pile_profile(Case& c, std::vector<Finding>& findings);

}  // namespace dipper::cases
