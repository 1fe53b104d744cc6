// The folder that a command's result goes to.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Makes the folder where it is not, before the work that would be lost without it. Throws
/// InputError, which names --out, when it cannot be made or written into.
void make_writable(const std::filesystem::path& folder);

/// The same of a folder that is made only once there is something to put into it. Makes nothing.
/// `remedy` says what to do where it cannot.
void require_writable(const std::filesystem::path& folder,
                      const std::string& remedy = "choose another --out");

/// What to do where the cache's folder cannot be written.
inline constexpr const char* kOtherCache = "set XDG_CACHE_HOME to a folder that can be written";

}  // namespace dipper
