#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dipper::launch {

/// Files that a child process reads and writes in place of /dev/null and its log; -1: none.
struct Streams {
  int in = -1, out = -1;
};

/// A child process. It cannot outlive the launcher, also when that is killed. stdout and stderr go
/// to `log`.
class Process {
 public:
  /// \param folder  its working folder; empty: the launcher's
  /// \param streams  the caller closes them
  /// Throws std::runtime_error when the program cannot be started.
  Process(const std::vector<std::string>& command, const std::filesystem::path& log,
          const std::filesystem::path& folder = {}, const Streams& streams = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Empty while it runs; then how it ended: "exit status 3", "killed by signal 9 (Killed)".
  std::optional<std::string> ended();
  bool succeeded();
  /// Ended by a signal from outside: no crash, and no exit of its own.
  bool was_killed();
  /// The program's name, without its folder.
  const std::string& name() const { return name_; }

  /// Waits for the end; false after `patience`.
  bool wait(std::chrono::milliseconds patience);

  /// SIGTERM first, then SIGKILL.
  void end();

  /// Time [s] that it has waited for a core. If it has children: of the leaf process that waited
  /// least, since a hung one does not wait.
  double starved_s() const;

  /// Time [s] that it has run or waited for a core. If it has children: the least of the leaf
  /// processes; constant while one of them is stopped or waits for something that never comes.
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
