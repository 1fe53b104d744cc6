// Features of the rock beyond motion and contact.
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
  bool contact = true;                   ///< whether bodies and rock are in contact in it
  bool all_rock_in = false;              ///< a feature needs all rock: none may be parked
};

/// LiggghtsRock calls its features in the order of its list. Each method is collective over the
/// ranks and does nothing by default.
class RockFeature {
 public:
  RockFeature() = default;
  virtual ~RockFeature() = default;
  RockFeature(const RockFeature&) = delete;
  RockFeature& operator=(const RockFeature&) = delete;

  /// Its channels of the record, the same through the whole run.
  virtual std::vector<core::Channel> channels() const { return {}; }

  /// This rank's part of each of its channels, appended; the record gets the sums over ranks.
  virtual void measure(const std::vector<Pose>& X_WB, std::vector<double>& parts) const {
    static_cast<void>(X_WB);
    static_cast<void>(parts);
  }

  /// Called at a run's start, not after a resume: with the walls in place, before LIGGGHTS sets up
  /// ...
  virtual void before_set_up() {}
  /// ... and after. True when forces have to be set up again.
  virtual bool after_set_up() { return false; }

  /// Whether all rock must be in LIGGGHTS through the window.
  virtual bool needs_all_rock(const RockWindow& window) const {
    static_cast<void>(window);
    return false;
  }
  /// Brings back all rock that it has removed from LIGGGHTS or stopped, and restarts with the next
  /// window.
  virtual void release() {}

  virtual void before_window(const RockWindow& window) { static_cast<void>(window); }
  virtual void after_window(const RockWindow& window) { static_cast<void>(window); }

  /// Saves its state for a checkpoint, and restores it after LIGGGHTS's rock. Saving does not
  /// change the run.
  virtual void save(ByteWriter& out) const { static_cast<void>(out); }
  virtual void load(ByteReader& in) { static_cast<void>(in); }
};

}  // namespace dipper::dem
