// Why a child process failed, in one line.
#pragma once

#include <filesystem>
#include <string>

#include "coupler/launch/process.hpp"

namespace dipper::launch {

/// The line of a failed side's log that gives the cause: LIGGGHTS's own "ERROR" line from its
/// screen file if there is one, else the host that mpirun has lost, else the side's own line
/// (dipper-dem:, dipper-mbs:), else the log's last line that is not mpirun's boilerplate; "" when
/// the log is empty.
std::string error_line(const std::filesystem::path& log, const std::filesystem::path& screen = {});

/// Of a process that has ended: the signal, if it was killed (its earlier output is then
/// unrelated); else the line of its log, and how it ended.
std::string failure_message(Process& process, const std::filesystem::path& log,
                            const std::filesystem::path& screen = {});

}  // namespace dipper::launch
