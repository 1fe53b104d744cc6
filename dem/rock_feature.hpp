// What the rock does beyond moving and touching, one feature each.
#pragma once

#include <cstdint>
#include <vector>

#include "common/frames.hpp"
#include "coupler/core/server.hpp"
#include "dem/bytes.hpp"

namespace dipper::dem {

/// The window that is about to run.
struct RockWindow {
  std::int64_t first_step = 0;  ///< DEM steps done when it begins
  std::int64_t n_steps = 0;
  const std::vector<Pose>& X_WB;         ///< of the bodies when it begins
  const std::vector<Pose>& X_WB_target;  ///< when it ends
  bool contact = true;                   ///< whether the bodies meet rock in it
  bool all_rock_in = false;              ///< a feature needs all rock: none may be taken out
};

/// LiggghtsRock calls its features in the order it lists them. Each method is collective over the
/// ranks; what a method does by default is nothing.
class RockFeature {
 public:
  RockFeature() = default;
  virtual ~RockFeature() = default;
  RockFeature(const RockFeature&) = delete;
  RockFeature& operator=(const RockFeature&) = delete;

  /// What it adds to the record, the same through the whole run.
  virtual std::vector<core::Channel> channels() const { return {}; }

  /// This rank's part of each of its channels, appended; the record gets the sums over ranks.
  virtual void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const {
    static_cast<void>(X_WB);
    static_cast<void>(parts);
  }

  /// At a run's start, not when it is resumed: with the walls in place, before LIGGGHTS sets up ...
  virtual void before_set_up() {}
  /// ... and after. True when forces have to be set up again.
  virtual bool after_set_up() { return false; }

  /// Whether all rock must be in LIGGGHTS through the window.
  virtual bool needs_all_rock(const RockWindow& window) const {
    static_cast<void>(window);
    return false;
  }
  /// Brings back all rock that it has taken out of LIGGGHTS or stopped, and begins anew with the
  /// next window.
  virtual void release() {}

  virtual void before_window(const RockWindow& window) { static_cast<void>(window); }
  virtual void after_window(const RockWindow& window) { static_cast<void>(window); }

  /// What a checkpoint must know of it, and back, once LIGGGHTS's rock is as it was. Saving changes
  /// nothing.
  virtual void save(ByteWriter& out) const { static_cast<void>(out); }
  virtual void load(ByteReader& in) { static_cast<void>(in); }
};

}  // namespace dipper::dem
