#include "coupler/check/cost_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/seconds.hpp"
#include "coupler/case/machine_kind.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/deck/rock_shape.hpp"
#include "machine/motion.hpp"

namespace dipper::check {
namespace {

// Measured: docs/benchmarks.md, "What a run takes".
constexpr double kStays = 0.85;            // of what is poured; the rest is over the bench
constexpr double kSettleRate = 4.5e6;      // sphere-steps a CPU-second, all rock computed
constexpr double kDigRate = 5e6;           // likewise, part of it at rest
constexpr double kHoldStep_s = 0.15e-3;    // with dem.hold_below_m_s, a step: what moves, walls,
constexpr double kHoldSphere_s = 15e-9;    // and a sphere in it, most at rest
constexpr double kWindowCost_s = 0.3e-3;   // machine side 0.1 ms, master with record 0.2 ms
constexpr double kMemory_B = 3000;         // a sphere
constexpr double kRankMemory_B = 60e6;     // a process
constexpr double kFrame_B = 17;            // a sphere
constexpr double kFrameWalls_B = 0.1e6;    // a frame
constexpr double kCheckpoint_B = 2 * 700;  // a sphere, in two of them
constexpr double kHeldCheckpoint_B = 2 * 280;  // likewise, most rock at rest and held
constexpr double kRecord_B = 4e6;              // record.h5 without rows
constexpr double kRow_B = 750;                 // a window in it
constexpr double kMessages_B = 3400;           // a window in the message log

double spheres_of(const cases::Case& c) {
  const auto counts = deck::rock_counts(c);
  double spheres = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto& shapes = c.rock.classes[i].shapes;
    const bool single = shapes.size() == 1 && shapes.front() == "sphere";
    spheres += counts[i].rocks * (single ? 1 : deck::spheres_a_rock(c.rock.shape_resolution));
  }
  return kStays * spheres;
}

std::string duration(double s) {
  if (s < 90) return fmt::format("{:.0f} s", s);
  if (s < 5400) return fmt::format("{:.0f} min", s / 60);
  return fmt::format("{:.0f} h {:.0f} min", std::floor(s / 3600), std::fmod(s, 3600) / 60);
}

std::string bytes(double b) {
  return b < 1e9 ? fmt::format("{:.0f} MB", b / 1e6) : fmt::format("{:.1f} GB", b / 1e9);
}

}  // namespace

CostEstimate cost_estimate(const cases::Case& c) {
  const double end_s = c.end_s > 0 ? c.end_s : cases::motion_end_s(c);
  const double steps = end_s / c.dem.timestep_s;
  const double windows = steps / c.coupling.sync_steps;
  const double settle_steps = (c.pile.settle_s + c.pile.relax_s) / c.dem.timestep_s;
  const double every_s = c.output.dump_every_s;
  const double frames = every_s > 0 ? std::floor(end_s / every_s) : 0;  // after that of the start
  CostEstimate e;
  e.spheres = spheres_of(c);
  e.settle_s = e.spheres * settle_steps / kSettleRate;
  e.dig_s = kWindowCost_s * windows + steps * (c.dem.hold_below_m_s > 0
                                                   ? kHoldStep_s + kHoldSphere_s * e.spheres
                                                   : e.spheres / kDigRate);
  e.wall_s = (e.settle_s + e.dig_s) / c.dem.ranks;
  e.memory_B = kMemory_B * e.spheres + kRankMemory_B * (c.dem.ranks + 2);
  const double frame_B = kFrame_B * e.spheres + kFrameWalls_B;
  e.record_B = kRecord_B + kRow_B * windows;
  e.dumps_B = frames * frame_B;
  const double checkpoints_B = c.dem.hold_below_m_s > 0 ? kHeldCheckpoint_B : kCheckpoint_B;
  e.disk_B = frame_B + e.dumps_B + checkpoints_B * e.spheres + e.record_B + kMessages_B * windows;
  return e;
}

std::string to_string(const CostEstimate& e) {
  return fmt::format(
      "estimate: {} of processor time ({} to dig, {} to settle the pile unless it is in the "
      "cache), {} of wall time if each rank has a core, {} of memory, {} of disk; accurate within "
      "a factor of 2",
      duration(e.dig_s + e.settle_s), duration(e.dig_s), duration(e.settle_s), duration(e.wall_s),
      bytes(e.memory_B), bytes(e.disk_B));
}

void report_full_disk(const cases::Case& c, const std::filesystem::path& folder,
                      Reporter& reporter) {
  std::filesystem::path there = std::filesystem::absolute(folder);
  std::error_code unknown;  // a folder without read permission is refused elsewhere
  while (!std::filesystem::exists(there, unknown) && there.has_relative_path())
    there = there.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(there, unknown);
  const double free_B = static_cast<double>(space.available), wanted_B = cost_estimate(c).disk_B;
  if (unknown || space.capacity == 0 || wanted_B < free_B) return;
  cases::Case quiet = c;
  quiet.output.dump_every_s = 0;
  reporter.line(fmt::format(
      "warning: output.dump_every_s: {} has {} free, but the run needs about {}; with 0, dumps at "
      "the start only, it needs {}",
      there.string(), bytes(free_B), bytes(wanted_B), bytes(cost_estimate(quiet).disk_B)));
}

}  // namespace dipper::check
