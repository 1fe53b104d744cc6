// The files of a run's folder, and the lock on it.
#pragma once

#include <filesystem>

#include "common/file_lock.hpp"

namespace dipper::result {

/// Held by the one process that writes the run: a second one is refused.
class RunFolder {
 public:
  /// Makes the folder of a new run. Throws InputError when it holds a run, or another process is
  /// writing one there.
  static RunFolder create(const std::filesystem::path& folder) { return {folder, false}; }

  /// Opens the folder of a run to resume. Throws InputError when it holds none, or the run is still
  /// in progress.
  static RunFolder resume(const std::filesystem::path& folder) { return {folder, true}; }

  const std::filesystem::path& root() const { return root_; }
  std::filesystem::path deck() const { return root_ / "deck"; }
  std::filesystem::path dumps() const { return root_ / "dumps"; }
  std::filesystem::path checkpoints() const { return root_ / "checkpoints"; }
  std::filesystem::path logs() const { return root_ / "logs"; }
  std::filesystem::path record() const { return root_ / "record.h5"; }
  std::filesystem::path decisions() const { return root_ / "operator"; }  ///< of one who plans
  std::filesystem::path faces() const { return root_ / "faces"; }  ///< seen before and after passes
  std::filesystem::path summary() const { return root_ / "summary.json"; }
  std::filesystem::path observed() const { return root_ / "observed"; }
  /// The regions in which the rock side weighs, which reports need.
  std::filesystem::path scales() const { return root_ / "scales.json"; }

  /// Exists from the end of a run until it is resumed: a manifest of the files that commands rely
  /// on, so that a bit that flips later is found (common/manifest.hpp). Dumps are not in it.
  void seal() const;
  void unseal() const;

 private:
  RunFolder(const std::filesystem::path& folder, bool resume);

  std::filesystem::path root_;
  FileLock lock_;
};

}  // namespace dipper::result
