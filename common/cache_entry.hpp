// A folder of the cache that many runs may need at once.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dipper {

/// Whether an entry exists and its files are undamaged (common/manifest.hpp).
bool is_sound(const std::filesystem::path& entry);

/// The lock file of the process that writes an entry, or a part that becomes one.
std::filesystem::path writers_lock(const std::filesystem::path& entry_or_part);

/// The lock on an entry, and the folder to write it in: an entry appears whole or not at all. Holds
/// the lock during its lifetime; the lock of a process that dies is released. Removes what dead
/// writers left in the cache.
class CacheWriter {
 public:
  /// Empty when another process is writing the entry; try again later. A damaged entry is moved
  /// aside with a warning. When a sound entry exists, the writer has nothing to do: see
  /// `is_needed`.
  static std::unique_ptr<CacheWriter> begin(const std::filesystem::path& entry);

  ~CacheWriter();
  CacheWriter(const CacheWriter&) = delete;
  CacheWriter& operator=(const CacheWriter&) = delete;

  /// False when the entry exists.
  bool is_needed() const;

  /// A new folder, removed with the writer unless it is kept.
  const std::filesystem::path& part() const;

  /// Turns the folder into the entry.
  void keep();

 private:
  struct State;
  explicit CacheWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Calls `write` with a new folder beside `entry`, and makes that folder the entry once `write` has
/// returned. Of several processes one writes and the others wait for it, calling `while_waiting`
/// ten times a second, which may throw to give up; if the writer dies, one of those that wait
/// takes over. A damaged entry is moved aside with a warning, and made again. Returns whether this
/// call wrote it. Exceptions of `write` are passed on.
bool make_once(const std::filesystem::path& entry,
               const std::function<void(const std::filesystem::path& part)>& write,
               const std::function<void()>& while_waiting);

/// An entry's name: the SHA-256 of `what`, the text of `files`, and names and text of all files of
/// a deck except its folders and case.in, on parts of which an entry does not depend.
std::string deck_hash(std::string what, const std::vector<std::filesystem::path>& files,
                      const std::filesystem::path& deck);

}  // namespace dipper
