// A path as the system finds it.
#pragma once

#include <filesystem>

namespace dipper {

/// Absolute and without "." and "..", which are resolved after the links before them, as the
/// system does: behind a link, "../x" is beside what it points to. The last name
/// is kept, even if it is a link: the user knows the file by it. Parts that do not exist are kept
/// as written. Throws InputError for an empty path, which only the name of a case can be.
std::filesystem::path resolved(const std::filesystem::path& path);

}  // namespace dipper
