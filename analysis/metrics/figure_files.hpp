// The machine's figure as files for ParaView.
#pragma once

#include <filesystem>
#include <functional>

#include "analysis/run/figure.hpp"

namespace dipper::analysis::metrics {

/// Writes FOLDER/paraview/NAME_N.vtp of the figure in W for the N-th time: one name for each body,
/// and "ropes". `part` numbers a body's parts from 1. A body that does not move is written once.
/// Calls `list` for each name and time with the file, relative to `folder`. Throws
/// std::runtime_error for a file that cannot be written.
void write_figure_files(const run::Figure& figure, const std::vector<double>& times_s,
                        const std::filesystem::path& folder,
                        const std::function<void(const std::string& name, double time_s,
                                                 const std::string& file)>& list);

}  // namespace dipper::analysis::metrics
