#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dipper::launch {

/// Files that a program reads and writes in place of /dev/null and its log; -1: none.
struct Streams {
  int in = -1, out = -1;
};

/// A program this run has started. It cannot outlive the launcher: not when the launcher ends, not
/// when it is killed. stdout and stderr go to `log`.
class Process {
 public:
  /// \param folder  in which it works, and drops what it drops; empty: where the launcher does
  /// \param streams  which stay the caller's to close
  /// Throws std::runtime_error when the program cannot be started.
  Process(const std::vector<std::string>& command, const std::filesystem::path& log,
          const std::filesystem::path& folder = {}, const Streams& streams = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Nothing while it runs; then how it ended: "exit status 3", "killed by signal 9 (Killed)".
  std::optional<std::string> ended();
  bool succeeded();
  /// Ended by a signal that others send: not a crash, nor an exit of its own.
  bool was_killed();
  /// Of the program, without its folder.
  const std::string& name() const { return name_; }

  /// Waits for the end; false after `patience`.
  bool wait(std::chrono::milliseconds patience);

  /// Asks, then forces.
  void end();

  /// How long it has waited for a core [s], or the last of the programs it started: the one that
  /// did least of them, since one that is hung does not wait.
  double starved_s() const;

  /// How long it has run or waited for a core [s], or of the programs it started the one that did
  /// least: it stands still while one of them is stopped or waits for what never comes.
  double active_s() const;

  /// CPU time [s] of the program and what it has started, so far.
  double cpu_s() const;

 private:
  std::string name_;
  pid_t pid_ = -1;
  bool running_ = false;
  int status_ = 0;
  double cpu_s_ = 0;
};

}  // namespace dipper::launch
