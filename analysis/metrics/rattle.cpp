#include "analysis/metrics/rattle.hpp"

#include <array>
#include <cmath>

namespace dipper::analysis::metrics {
namespace {

constexpr const char* kMean = "bodies/dipper/wrench_mean";
constexpr const char* kEnd = "bodies/dipper/wrench_end";
constexpr std::array<std::size_t, 3> kForce{3, 4, 5};  // torque goes first

}  // namespace

Rattle::Rattle(const std::filesystem::path& record) : columns_(record) {
  columns_.read("time_s");
  for (const std::size_t k : kForce)
    for (const char* channel : {kMean, kEnd}) columns_.read(channel, k);
}

double Rattle::share(const signals::TimeSpan& time, double jump_N) const {
  const auto time_s = columns_.get("time_s");
  std::vector<double> square(time_s.size());
  for (const std::size_t k : kForce) {
    const auto mean = columns_.get(kMean, k), end = columns_.get(kEnd, k);
    for (std::size_t i = 0; i < square.size(); ++i) square[i] += std::pow(end[i] - mean[i], 2);
  }
  std::size_t windows = 0, jumps = 0;
  for (std::size_t i = 0; i < square.size(); ++i) {
    if (time_s[i] < time.t_start_s || time_s[i] > time.t_end_s) continue;
    ++windows;
    if (square[i] > jump_N * jump_N) ++jumps;
  }
  return windows == 0 ? 0 : static_cast<double>(jumps) / static_cast<double>(windows);
}

}  // namespace dipper::analysis::metrics
