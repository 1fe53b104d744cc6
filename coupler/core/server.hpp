// The two sides of a paired run as the master sees them. Each can be a process across LCM, a fake
// in a test, an analytic model, or a recording.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/frames.hpp"
#include "common/height_map.hpp"

namespace dipper::core {

/// One recorded signal: what the side's `channels` vector holds at the same place.
struct Channel {
  std::string name;   ///< e.g. "crowd_force"
  std::string unit;   ///< SI, e.g. "N"
  std::string frame;  ///< "W", "H", "B", "D", or "-" for a scalar
};

/// What a side says of itself once it is ready.
struct ServerInfo {
  std::string version;              ///< program and library versions
  std::vector<std::string> bodies;  ///< names, in the order of every body vector
  std::vector<Channel> channels;
  double timestep_s = 0;  ///< the side's own step; the sync step is a multiple of the DEM's
};

/// Where a channel is in every `channels` vector. Throws std::invalid_argument when there is none.
inline std::size_t channel_index(const ServerInfo& info, const std::string& name) {
  for (std::size_t i = 0; i < info.channels.size(); ++i) {
    if (info.channels[i].name == name) return i;
  }
  throw std::invalid_argument(info.version + " has no channel " + name);
}

/// The machine at one instant. One entry a body; `channels` as announced.
struct MachineState {
  std::int64_t t_ns = 0;
  std::vector<BodyState> bodies;
  std::vector<double> channels;
  bool contact = true;          ///< whether the bodies meet rock, from this instant on
  std::vector<Pose> X_WB_next;  ///< where the bodies will be, extrapolated to the time asked for
};

/// Where a machine's drives are to be at a time, in the machine's own order; nothing: as before.
struct Order {
  std::int64_t by_ns = 0;
  std::vector<double> to = {};
};

/// A window of the machine.
struct MachineStep {
  std::int64_t t_end_ns = 0;
  std::vector<Wrench> F_Bo_W;   ///< rock on body, about the body's moving origin, world axes; held
  std::int64_t t_next_ns = 0;   ///< end of the window that follows; not after t_end_ns: none does
  std::int64_t step_index = 0;  ///< windows completed before it
  Order order = {};             ///< of who drives it from outside, given at the window's start
};

/// The machine (Simbody): wrenches in, motion out. It only goes forward.
class Machine {
 public:
  virtual ~Machine() = default;
  virtual ServerInfo info() const = 0;

  /// The state the machine is in (after construction: t = 0), and where its bodies will be at
  /// t_next_ns: prescribed joints by their motion, the others by their speeds and accelerations.
  virtual MachineState state(std::int64_t t_next_ns) = 0;

  /// Integrates to the window's end. With where the bodies will be at the end of the next.
  virtual MachineState step(const MachineStep& step) = 0;

  /// Writes, reads the state; load(save(s)) continues bit-exactly.
  virtual void save(const std::filesystem::path& file) = 0;
  virtual void load(const std::filesystem::path& file) = 0;

  /// More of the motion it follows: rows of motion.csv without their head, all later than its last.
  virtual void follow(const std::string& rows) {
    static_cast<void>(rows);
    throw std::logic_error("this machine follows no motion");
  }
};

/// What a body felt over one window, and where it really is at the window's end.
struct BodyLoad {
  Wrench mean;  ///< over the window's DEM steps by the trapezoidal rule, so that mean * H is the
                ///< impulse velocity Verlet gave the rock; about the body's origin, world axes
  Wrench end;   ///< at the last DEM step
  Pose X_WB;    ///< read back from the wall mesh
};

/// The rock at the end of a window.
struct RockState {
  std::int64_t step = 0;  ///< DEM steps since the start of the run
  std::int64_t t_ns = 0;
  std::vector<BodyLoad> bodies;
  std::vector<double> channels;
};

/// A window of the rock.
struct RockStep {
  std::int64_t n_steps = 0;       ///< DEM steps
  std::vector<Pose> X_WB_target;  ///< every wall moves there from where it is, at constant twist
  bool contact = true;            ///< whether the bodies meet rock
  std::int64_t t_end_ns = 0;
  std::int64_t step_index = 0;  ///< windows completed before it
};

/// The rock (LIGGGHTS): motion in, wrenches out.
class Rock {
 public:
  virtual ~Rock() = default;
  virtual ServerInfo info() const = 0;

  /// Puts the walls where the machine's bodies start (before the first step only).
  virtual RockState place(const std::vector<Pose>& X_WB) = 0;

  /// Begins a window; `finish` comes next. A rock in another process computes between the two.
  virtual void start(const RockStep& step) = 0;

  /// The end of the window that was started.
  virtual RockState finish() = 0;

  /// Writes a checkpoint. A rock is not loaded: it is started from the file (LIGGGHTS reads a
  /// restart file only into an empty simulation).
  virtual void save(const std::filesystem::path& file) = 0;

  /// The rock seen from above (common/height_map.hpp), as it is between two windows. Changes
  /// nothing.
  virtual HeightMap look(const HeightGrid& grid) {
    static_cast<void>(grid);
    throw std::logic_error("this rock has no surface to look at");
  }

  /// SHA-256 over every particle's id, position and velocity, in the order of ids.
  virtual std::string state_hash() = 0;
};

/// A rock that steps in the caller's own process and time.
class LocalRock : public Rock {
 public:
  virtual RockState step(const RockStep& step) = 0;
  void start(const RockStep& step) final { result_ = this->step(step); }
  RockState finish() final { return std::move(result_); }

 private:
  RockState result_;
};

}  // namespace dipper::core
