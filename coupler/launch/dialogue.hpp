// Exchange of lines with a program.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupler/launch/process.hpp"

namespace dipper::launch {

/// Owns the program's stdin and stdout; its stderr goes to a log. SIGPIPE must be ignored
/// (catch_interrupts does that).
class Dialogue {
 public:
  /// \param patience  for each line, without the time that the program waits for a core
  /// \param watch     called at least every 50 ms while waiting; throws to give up
  /// Throws std::runtime_error when the program cannot be started.
  Dialogue(const std::vector<std::string>& command, const std::filesystem::path& log,
           const std::filesystem::path& folder, std::chrono::milliseconds patience,
           std::function<void()> watch);
  ~Dialogue();
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;

  /// Sends a line; `line` has no newline. Throws std::runtime_error when the program has ended,
  /// with its exit and last output, or does not read.
  void say(const std::string& line);

  /// The next line, without its newline. Throws std::runtime_error when the program has ended,
  /// writes nothing for `patience`, or writes a line longer than 64 MiB.
  std::string hear();

  /// Closes its stdin and waits for its end. True if it ended by itself with exit status 0.
  bool dismiss(std::chrono::milliseconds patience);

 private:
  /// Waits until a pipe can be read or written. `doing`: the error's text if the time runs out.
  void wait_for(int file, short event, const char* doing,
                std::chrono::steady_clock::time_point began, double starved_s);
  [[noreturn]] void report_end();
  void close_files();

  std::filesystem::path log_;
  std::chrono::milliseconds patience_;
  std::function<void()> watch_;
  int to_ = -1, from_ = -1;
  std::string heard_;  ///< beyond the last line
  std::unique_ptr<Process> process_;
};

}  // namespace dipper::launch
