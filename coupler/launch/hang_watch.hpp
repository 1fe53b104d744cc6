// Whether a program that answers no requests still makes progress.
#pragma once

#include <cstdint>
#include <string>

namespace dipper::launch {

/// Watches the output of a long computation, and the time in which it ran or waited for a core.
/// Does no I/O: the caller gives the times. A program hangs
///  - when it neither writes nor runs for `idle_s`: it is stopped, or waits for something that
///  never comes;
///  - when it runs but writes nothing for an hour, or for 30 times the longest gap so far,
///    whichever is longer: ranks that wait for each other run at full speed.
/// A slow program, or one on a loaded machine, writes late, but runs or waits for a core.
class HangWatch {
 public:
  explicit HangWatch(double idle_s) : idle_s_(idle_s) {}

  /// Call in order of time, with `active_s` of Process and the bytes written so far. Returns why it
  /// hangs; "" when it does not.
  std::string look(double now_s, double active_s, std::uintmax_t written);

 private:
  double idle_s_;
  bool began_ = false;
  std::uintmax_t written_ = 0;
  double wrote_s_ = 0;        ///< when it last wrote
  double longest_gap_s_ = 0;  ///< between two outputs
  double active_s_ = 0;
  double ran_s_ = 0;  ///< when it last was seen to have run
};

}  // namespace dipper::launch
