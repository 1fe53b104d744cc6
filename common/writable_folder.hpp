// The folder that a command's result goes to.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Makes the folder where it is not, before the work that would be lost without it. Throws
/// InputError when it cannot be made or written into; `remedy` says what to do then.
void make_writable(const std::filesystem::path& folder,
                   const std::string& remedy = "choose another --out");

/// The same of a folder that is made only once there is something to put into it. Makes nothing.
void require_writable(const std::filesystem::path& folder);

/// What to do where the cache's folder cannot be written.
inline constexpr const char* kOtherCache = "set XDG_CACHE_HOME to a folder that can be written";

}  // namespace dipper
