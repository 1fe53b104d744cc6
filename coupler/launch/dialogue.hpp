// A program that is spoken with: a line to it, a line back.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupler/launch/process.hpp"

namespace dipper::launch {

/// Has the program's stdin and stdout; its stderr goes to a log. SIGPIPE must be ignored
/// (catch_interrupts does that).
class Dialogue {
 public:
  /// \param patience  for each line, its time without a core not counted
  /// \param watch     called at least every 50 ms while waiting; throws to give up
  /// Throws std::runtime_error when the program cannot be started.
  Dialogue(const std::vector<std::string>& command, const std::filesystem::path& log,
           const std::filesystem::path& folder, std::chrono::milliseconds patience,
           std::function<void()> watch);
  ~Dialogue();
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;

  /// Sends a line; `line` has no end of one. Throws std::runtime_error when the program has ended,
  /// with how and its last words, or does not read.
  void say(const std::string& line);

  /// The next line, without its end. Throws std::runtime_error when the program has ended, says
  /// nothing until the patience is over, or a line is longer than 64 MiB.
  std::string hear();

  /// Closes its stdin and waits for its end; whether it has ended by itself with exit status 0.
  bool dismiss(std::chrono::milliseconds patience);

 private:
  /// Until a file can be read or written. `doing` is what the program does not do, if it cannot.
  void wait_for(int file, short event, const char* doing,
                std::chrono::steady_clock::time_point began, double starved_s);
  [[noreturn]] void tell_end();
  void close_files();

  std::filesystem::path log_;
  std::chrono::milliseconds patience_;
  std::function<void()> watch_;
  int to_ = -1, from_ = -1;
  std::string heard_;  ///< beyond the last line
  std::unique_ptr<Process> process_;
};

}  // namespace dipper::launch
