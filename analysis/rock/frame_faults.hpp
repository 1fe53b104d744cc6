// Faults of a frame that show in all its particles together.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "analysis/io/dump_reader.hpp"

namespace dipper::analysis::rock {

/// Sees each particle of a frame. Throws InputError naming file and line.
class FrameFaults {
 public:
  explicit FrameFaults(const io::DumpFrame& frame) : frame_(frame) {}

  /// Refuses an id that was seen before.
  void see(std::int64_t id, double radius_m, const Eigen::Vector3d& p_W);

  /// After the last one: refuses spheres that together are far larger than the box, and many of
  /// which most are outside it.
  void judge() const;

 private:
  bool is_new(std::int64_t id);

  const io::DumpFrame& frame_;
  std::vector<bool> small_ids_;
  std::unordered_set<std::int64_t> other_ids_;
  std::size_t particles_ = 0, outside_ = 0;
  double volume_m3_ = 0, largest_radius_m_ = 0;
};

}  // namespace dipper::analysis::rock
