// The folder of a command's results.
#pragma once

#include <filesystem>
#include <string>

namespace dipper {

/// Makes the folder if it does not exist, before the work that would be lost without it. Throws
/// InputError when it cannot be made or written into; `remedy` says what to do then.
void make_writable(const std::filesystem::path& folder,
                   const std::string& remedy = "choose another --out");

/// Checks the same for a folder that is made later. Makes nothing.
void require_writable(const std::filesystem::path& folder);

/// The remedy when the cache's folder cannot be written.
inline constexpr const char* kOtherCache = "set XDG_CACHE_HOME to a folder that can be written";

}  // namespace dipper
