#pragma once

#include <filesystem>

namespace dipper::run {

/// Writes {dipper,door,truck}.vtk.series into the dump folder: lists of the frames there with
/// their times, which ParaView opens as one animated data set each.
void index_dumps(const std::filesystem::path& dumps, double timestep_s);

}  // namespace dipper::run
