// A run's faces (coupler/run/face_survey.hpp) as sections: profile.csv of observed/.
#pragma once

#include <filesystem>

#include "analysis/signals/drive_signals.hpp"
#include "analysis/signals/passes.hpp"

namespace dipper::result {

/// face_K.json in `folder`, K from 0: the face before the first pass, then after each.
std::filesystem::path face_file(const std::filesystem::path& folder, int number);

/// Removes faces that were seen after t_s; how many stay. Throws InputError naming a file that
/// cannot be read.
int keep_faces_until(const std::filesystem::path& folder, double t_s);

/// Writes `out`/profile.csv: of each dumped pass the section along the boom where it dug, before
/// the pass (after 0) and after it (after 1): the median over a lane of kLaneHalf_m to both sides,
/// x from the swing axis, z over the ground. Writes nothing, and says false, where `folder` has no
/// face of a pass.
bool write_profiles(const std::filesystem::path& folder,
                    const analysis::signals::DriveSignals& drives,
                    const std::vector<analysis::signals::Pass>& passes,
                    const std::filesystem::path& out);
inline constexpr double kLaneHalf_m = 2.0;

}  // namespace dipper::result
