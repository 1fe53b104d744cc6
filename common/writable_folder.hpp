// The folder that a command's result goes to.
#pragma once

#include <filesystem>

namespace dipper {

/// Makes the folder where it is not, before the work that would be lost without it. Throws
/// InputError, which names --out, when it cannot be made or written into.
void make_writable(const std::filesystem::path& folder);

/// The same of a folder that is made only once there is something to put into it. Makes nothing.
void require_writable(const std::filesystem::path& folder);

}  // namespace dipper
