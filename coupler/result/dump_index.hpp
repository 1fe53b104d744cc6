#pragma once

#include <cstdint>
#include <filesystem>

namespace dipper::result {

/// Writes BODY.vtk.series into the dump folder for each body that has frames there: lists of them
/// with their times, which ParaView opens as one animated data set each.
void index_dumps(const std::filesystem::path& dumps, double timestep_s);

/// Removes the frames of later steps, which a run that resumes at this step does not have, and what
/// a killed process left half written.
void drop_frames_after(const std::filesystem::path& dumps, std::int64_t step);

}  // namespace dipper::result
