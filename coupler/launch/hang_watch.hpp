// Whether a program that has no one to answer to still gets on.
#pragma once

#include <cstdint>
#include <string>

namespace dipper::launch {

/// Looks at what a long computation shows of itself: its output, and the time in which it ran or
/// waited for a core. Pure: the times are given. A program hangs
///  - when it neither writes nor runs for `idle_s`: it is stopped, or waits for what never comes;
///  - when it runs but writes nothing for an hour, or for 30 times as long as ever before,
///  whichever
///    is longer: ranks that wait for each other do so at full speed.
/// One that is slow, or on a loaded machine, writes late but runs, or would if it had a core.
class HangWatch {
 public:
  explicit HangWatch(double idle_s) : idle_s_(idle_s) {}

  /// At `now_s`, in order of time: `active_s` of Process, and how much the program has written.
  /// Returns what shows that it hangs; "" when nothing does.
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
