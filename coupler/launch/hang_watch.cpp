#include "coupler/launch/hang_watch.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace dipper::launch {
namespace {

constexpr double kSilence_s = 3600;
constexpr double kSilenceInGaps = 30;
constexpr double kRan_s = 1e-3;  // a process that only wakes to read the clock runs less

}  // namespace

std::string HangWatch::look(double now_s, double active_s, std::uintmax_t written) {
  if (!began_ || written != written_) {
    if (began_) longest_gap_s_ = std::max(longest_gap_s_, now_s - wrote_s_);
    written_ = written;
    wrote_s_ = now_s;
  }
  // A smaller value is progress, too: another of its child processes is now the slowest.
  if (!began_ || std::abs(active_s - active_s_) > kRan_s) {
    active_s_ = active_s;
    ran_s_ = now_s;
  }
  began_ = true;
  const double idle_s = now_s - std::max(wrote_s_, ran_s_);
  if (idle_s > idle_s_)
    return fmt::format("it did not run, wait for a core or write anything for {:g} s", idle_s_);
  const double silence_s = std::max(kSilence_s, kSilenceInGaps * longest_gap_s_);
  if (now_s - wrote_s_ > silence_s)
    return fmt::format("it runs but has written nothing for {:.0f} s", silence_s);
  return "";
}

}  // namespace dipper::launch
