// A folder of the cache that many runs may want at once.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dipper {

/// Whether an entry is there and its files are what was written (common/manifest.hpp).
bool is_sound(const std::filesystem::path& entry);

/// What the process that writes an entry has locked; of the entry, or of a part that is to become
/// it.
std::filesystem::path writers_lock(const std::filesystem::path& entry_or_part);

/// The right to write an entry, and the folder to write it in: an entry appears whole or not at
/// all. Other processes are kept out as long as this lives, and a process that dies keeps nobody
/// out. What writers that died have left in the cache is removed.
class CacheWriter {
 public:
  /// Empty when another is writing the entry; ask again later. An entry that is there and is not
  /// what was written is set aside with a warning. When the entry is there and sound, the
  /// writer is one that has nothing to do: see `is_needed`.
  static std::unique_ptr<CacheWriter> begin(const std::filesystem::path& entry);

  ~CacheWriter();
  CacheWriter(const CacheWriter&) = delete;
  CacheWriter& operator=(const CacheWriter&) = delete;

  /// False: the entry is there, somebody has made it.
  bool is_needed() const;

  /// A new folder, gone with the writer unless it is kept.
  const std::filesystem::path& part() const;

  /// Makes the folder the entry.
  void keep();

 private:
  struct State;
  explicit CacheWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Calls `write` with a new folder beside `entry`, and makes that folder the entry once `write` has
/// returned. Of several processes one writes and the others wait for it, calling `while_waiting`
/// ten times a second, which may throw to give up; should the writer die, one of those that wait
/// takes over. An entry that is not what was written is set aside with a warning, and made
/// again. Returns whether it was this call that wrote. What `write` throws is passed on.
bool make_once(const std::filesystem::path& entry,
               const std::function<void(const std::filesystem::path& part)>& write,
               const std::function<void()>& while_waiting);

/// An entry's name: the SHA-256 of `what`, the text of `files`, and names and text of all that a
/// deck holds but its folders and case.in, which also have what an entry does not depend on.
std::string deck_hash(std::string what, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& deck);

}  // namespace dipper
