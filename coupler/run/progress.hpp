#pragma once

#include <chrono>
#include <string>

namespace dipper::run {

/// One line that tells how a run is doing: rewritten in place on a terminal, a new line every ten
/// seconds elsewhere.
class Progress {
 public:
  Progress(double start_s, double end_s);
  void show(double t_s, double payload_kg);
  /// Leaves the last line standing.
  void done();

 private:
  std::string line(double t_s, double payload_kg) const;
  std::chrono::steady_clock::time_point began_, last_;
  double start_s_, end_s_;
  bool terminal_;
  bool shown_ = false;
};

}  // namespace dipper::run
