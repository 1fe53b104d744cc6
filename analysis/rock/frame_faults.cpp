#include "analysis/rock/frame_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/io/line_reader.hpp"

namespace dipper::analysis::rock {
namespace {

constexpr std::int64_t kMostSmall = std::int64_t{1} << 28;  // 32 MB of bits
constexpr std::size_t kMany = 20;                           // particles: a few may be anywhere
constexpr double kOverlap = 10;  // volume of a clump's spheres by the clump's, and more

}  // namespace

bool FrameFaults::is_new(std::int64_t id) {
  if (id < 0 || id >= kMostSmall) return other_ids_.insert(id).second;
  const auto at = static_cast<std::size_t>(id);
  if (at >= small_ids_.size()) small_ids_.resize(std::max(at + 1, 2 * small_ids_.size()));
  if (small_ids_[at]) return false;
  small_ids_[at] = true;
  return true;
}

void FrameFaults::see(std::int64_t id, double radius_m, const Eigen::Vector3d& p_W) {
  if (!is_new(id))
    throw io::input_error(frame_.file, frame_.line,
                          fmt::format("id {} occurs twice in the frame of step {}; each particle "
                                      "needs an id of its own, the same in every frame",
                                      id, frame_.step));
  ++particles_;
  volume_m3_ += 4.0 / 3.0 * M_PI * radius_m * radius_m * radius_m;
  largest_radius_m_ = std::max(largest_radius_m_, radius_m);
  if (frame_.box && !frame_.box->grown(radius_m).holds(p_W)) ++outside_;
}

void FrameFaults::judge() const {
  if (!frame_.box || particles_ < kMany) return;
  const Eigen::Vector3d sides = frame_.box->sides_m();
  const auto refuse = [&](const std::string& what) {
    throw io::input_error(frame_.file, frame_.line, what);
  };
  const double room_m3 = frame_.box->grown(largest_radius_m_).sides_m().prod();
  if (volume_m3_ > kOverlap * room_m3)
    refuse(
        fmt::format("{} particles of up to {:.4g} m in radius do not fit into the box of "
                    "{:.4g} x {:.4g} x {:.4g} m: is the radius in mm? write it in m",
                    particles_, largest_radius_m_, sides.x(), sides.y(), sides.z()));
  if (frame_.tilted || !frame_.has("x")) return;  // unwrapped positions leave the box
  if (2 * outside_ > particles_)
    refuse(
        fmt::format("{} of {} particles are outside the box of {:.4g} x {:.4g} x {:.4g} m: are "
                    "their positions in mm? write them in m",
                    outside_, particles_, sides.x(), sides.y(), sides.z()));
}

}  // namespace dipper::analysis::rock
