// The terminal, or the file or pipe in its place.
#pragma once

#include <chrono>
#include <string>

#include "common/reporter.hpp"

namespace dipper::cli {

/// Lines on stdout, errors on stderr after "dipper: ". Progress is rewritten in place on a
/// terminal, and is a new line every ten seconds elsewhere. A closed
/// reading end is not an error: what cannot be written is dropped.
class Console final : public Reporter {
 public:
  Console();
  ~Console() override { end_progress(); }
  void line(const std::string& text) override;
  void error(const std::string& text) override;
  void progress(const std::string& text) override;

 private:
  void show(const std::string& text);
  void end_progress();

  bool terminal_;
  bool begun_ = false;   ///< a line of progress is on the terminal
  std::string pending_;  ///< the latest progress, not shown yet
  std::chrono::steady_clock::time_point shown_;
};

}  // namespace dipper::cli
