// A file that is read whole, and a text file that is written whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dipper {

/// All bytes of the file; none when it cannot be opened or read to its end, as a folder, or a file
/// of proc(5) whose process has just ended. Throws nothing but std::bad_alloc.
std::optional<std::string> read_bytes(const std::filesystem::path& file);

/// Replaces the file's contents by these bytes. Throws std::runtime_error naming the file when they
/// cannot be written to the end; the old contents then remain.
void write_text(const std::filesystem::path& file, const std::string& text);

/// Replaces the file `to` by a copy of `from`, without its permissions: the copy can be replaced
/// again. Throws std::runtime_error naming the file that cannot be read or written.
void copy_contents(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace dipper
