// Folders whose files must not change: a bit that flips later, or a file that was cut short, is
// found before it is used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dipper {

/// In the format of sha256sum, so that `sha256sum -c` checks a folder by hand.
inline constexpr const char* kManifest = "manifest.sha256";

/// Writes what the system still holds of a file or folder to the disk. Throws std::system_error.
void sync(const std::filesystem::path& path);

/// Writes a manifest of all files in a folder and below, and syncs all of them to the disk: after a
/// rename of the folder it exists whole or not at all, even after a power failure. A process killed
/// meanwhile leaves no manifest. Throws std::runtime_error or std::system_error when it cannot be
/// written.
void seal(const std::filesystem::path& folder);

/// The same of some of them: files, and folders with all in them, relative to `folder`.
void seal(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& parts);

/// The fault of a sealed folder, "" when there is none: the first file, by its path, that is
/// missing or has changed, or a missing manifest. Files that the manifest does not name are not
/// read.
std::string damage_of(const std::filesystem::path& folder);

/// Throws InputError naming the file when a folder that has a manifest is damaged. One without is
/// accepted: its contents cannot be checked.
void require_undamaged(const std::filesystem::path& folder);

/// Renames a sealed folder and syncs that to the disk. Throws std::filesystem::filesystem_error.
void rename_sealed(const std::filesystem::path& from, const std::filesystem::path& to);

/// Moves a damaged file or folder to PATH.damaged, replacing what was moved there before; returns
/// the new path.
std::filesystem::path set_aside(const std::filesystem::path& path);

}  // namespace dipper
