// Folders whose files must be what was written: a bit that flips later, or a file that was cut
// short, is found before it is used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dipper {

/// Its lines are those of sha256sum, so that `sha256sum -c` checks a folder by hand.
inline constexpr const char* kManifest = "manifest.sha256";

/// Writes a manifest of all files in a folder and those below, and sees to it that they and it are
/// on the disk: after a rename of the folder it is there whole, or not at all, even when the power
/// fails. A process killed meanwhile leaves no manifest. Throws std::runtime_error or
/// std::system_error when it cannot be written.
void seal(const std::filesystem::path& folder);

/// The same of some of them: files, and folders with all in them, relative to `folder`.
void seal(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& parts);

/// What is wrong with a sealed folder, "" when nothing is: the first file, by its path, that is
/// missing or is not what was written, or that there is no manifest. Files that the manifest does
/// not name are not looked at.
std::string damage_of(const std::filesystem::path& folder);

/// Throws InputError naming the file when a folder that has a manifest is damaged. One without is
/// taken as it is: nobody knows what it should hold.
void require_undamaged(const std::filesystem::path& folder);

/// Renames a sealed folder and writes that to the disk. Throws std::filesystem::filesystem_error.
void rename_sealed(const std::filesystem::path& from, const std::filesystem::path& to);

/// Moves what is damaged out of the way, to PATH.damaged, in place of what was moved there before;
/// the new path.
std::filesystem::path set_aside(const std::filesystem::path& path);

}  // namespace dipper
