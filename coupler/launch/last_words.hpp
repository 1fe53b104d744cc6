#pragma once

#include <filesystem>
#include <string>

namespace dipper::launch {

/// What a side that failed said last: LIGGGHTS's own "ERROR" line from its screen file if there is
/// one, else the side's own line (dipper-dem:, dipper-mbs:), else the log's last line that is not
/// mpirun's boilerplate; "" when it said nothing.
std::string last_words(const std::filesystem::path& log, const std::filesystem::path& screen = {});

}  // namespace dipper::launch
