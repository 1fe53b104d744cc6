// A path as the system finds it.
#pragma once

#include <filesystem>

namespace dipper {

/// Absolute and without "." and "..", which are taken after the links before them have been
/// followed, as the system does: behind a link, "../x" is beside what it points to. The last name
/// is kept as it is, be it a link: it names the file to the user. What is not there is kept as
/// written.
std::filesystem::path resolved(const std::filesystem::path& path);

}  // namespace dipper
