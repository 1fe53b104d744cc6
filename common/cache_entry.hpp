// A folder of the cache that many runs may want at once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dipper {

/// Calls `write` with a new folder beside `entry`, and makes that folder the entry once `write` has
/// returned: an entry appears whole or not at all. Of several processes one writes and the others
/// wait for it, calling `while_waiting` ten times a second, which may throw to give up; should the
/// writer die, one of those that wait takes over. What writers that died have left in the cache is
/// removed. Returns whether it was this call that wrote. What `write` throws is passed on.
bool make_once(const std::filesystem::path& entry,
               const std::function<void(const std::filesystem::path& part)>& write,
               const std::function<void()>& while_waiting);

/// An entry's name: the SHA-256 of `what`, the text of `files`, and names and text of all that a
/// deck holds but its folders and case.in, which also have what an entry does not depend on.
std::string deck_hash(std::string what, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& deck);

}  // namespace dipper
