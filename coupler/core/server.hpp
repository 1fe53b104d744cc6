// The two sides of a paired run as the master uses them. Each can be a process across LCM, a fake
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

/// One recorded signal: describes the element of the side's `channels` vector at the same index.
struct Channel {
  std::string name;   ///< e.g. "crowd_force"
  std::string unit;   ///< SI, e.g. "N"
  std::string frame;  ///< "W", "H", "B", "D", or "-" for a scalar
};

/// The description that a side gives once it is ready.
struct ServerInfo {
  std::string version;              ///< program and library versions
  std::vector<std::string> bodies;  ///< names, in the order of every vector over bodies
  std::vector<Channel> channels;
  double timestep_s = 0;  ///< the side's own step; the sync step is a multiple of the DEM step
};

/// The index of a channel in every `channels` vector. Throws std::invalid_argument when there is
/// none.
inline std::size_t channel_index(const ServerInfo& info, const std::string& name) {
  for (std::size_t i = 0; i < info.channels.size(); ++i) {
    if (info.channels[i].name == name) return i;
  }
  throw std::invalid_argument(info.version + " has no channel " + name);
}

/// The machine at one instant. Vectors have one element for each body; `channels` as described.
struct MachineState {
  std::int64_t t_ns = 0;
  std::vector<BodyState> bodies;
  std::vector<double> channels;
  bool contact = true;          ///< whether the bodies touch rock, from this instant on
  std::vector<Pose> X_WB_next;  ///< the bodies' poses, extrapolated to the requested time
};

/// Set points of a machine's drives at a time, in the machine's own order; empty: no change.
struct Order {
  std::int64_t by_ns = 0;
  std::vector<double> to = {};
};

/// A window of the machine.
struct MachineStep {
  std::int64_t t_end_ns = 0;
  /// Of the rock on each body, about the body's moving origin, world axes; constant.
  std::vector<Wrench> F_Bo_W;
  std::int64_t t_next_ns = 0;   ///< end of the next window; not after t_end_ns: there is none
  std::int64_t step_index = 0;  ///< windows completed earlier
  Order order = {};             ///< of a program that drives, given at the window's start
};

/// The machine (Simbody): wrenches in, motion out. It only goes forward.
class Machine {
 public:
  virtual ~Machine() = default;
  virtual ServerInfo info() const = 0;

  /// The current state (after construction: t = 0), with the bodies' poses extrapolated to
  /// t_next_ns: prescribed joints by their motion, the others by their speeds and accelerations.
  virtual MachineState state(std::int64_t t_next_ns) = 0;

  /// Integrates to the window's end. Returns the state there, extrapolated to the end of the next
  /// window.
  virtual MachineState step(const MachineStep& step) = 0;

  /// Writes and reads the state; load(save(s)) continues bit-exactly.
  virtual void save(const std::filesystem::path& file) = 0;
  virtual void load(const std::filesystem::path& file) = 0;

  /// Appends rows of motion.csv, without their header, to the motion; all later than its last row.
  virtual void follow(const std::string& rows) {
    static_cast<void>(rows);
    throw std::logic_error("this machine follows no motion");
  }
};

/// The load on a body over one window, and its actual pose at the window's end.
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
  std::vector<Pose> X_WB_target;  ///< every wall moves to it at constant twist
  bool contact = true;            ///< whether the bodies touch rock
  std::int64_t t_end_ns = 0;
  std::int64_t step_index = 0;  ///< windows completed earlier
};

/// The rock (LIGGGHTS): motion in, wrenches out.
class Rock {
 public:
  virtual ~Rock() = default;
  virtual ServerInfo info() const = 0;

  /// Places the walls at the machine's bodies (before the first step only).
  virtual RockState place(const std::vector<Pose>& X_WB) = 0;

  /// Starts a window; `finish` must follow. A rock in another process computes in between.
  virtual void start(const RockStep& step) = 0;

  /// Waits for the end of the started window.
  virtual RockState finish() = 0;

  /// Writes a checkpoint. There is no load: a rock process is started from the file (LIGGGHTS reads
  /// a restart file only into an empty simulation).
  virtual void save(const std::filesystem::path& file) = 0;

  /// The rock surface seen from above (common/height_map.hpp), between two windows. Does not change
  /// the rock.
  virtual HeightMap look(const HeightGrid& grid) {
    static_cast<void>(grid);
    throw std::logic_error("this rock has no surface to look at");
  }

  /// SHA-256 over every particle's id, position and velocity, in the order of ids.
  virtual std::string state_hash() = 0;
};

/// A rock that steps in the caller's process and thread.
class LocalRock : public Rock {
 public:
  virtual RockState step(const RockStep& step) = 0;
  void start(const RockStep& step) final { result_ = this->step(step); }
  RockState finish() final { return std::move(result_); }

 private:
  RockState result_;
};

}  // namespace dipper::core
