// The rules that decide which rock at rest need not be computed; without LIGGGHTS.
//
// A rock (a sphere, or a multisphere as a whole) is
//   moving   integrated as usual;
//   held     computed but not moved: the boundary that moving rock rests on;
//   parked   removed from the simulation, with its contact history, since nothing that moves can
//            touch it.
// The paper's simplified model (Svanberg et al. 2021, section 3.2, Fig. 11b) does the same once, by
// hand: particles at rest removed, a layer of 0.5 m held.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/box.hpp"
#include "common/frames.hpp"
#include "coupler/setup/rock_setup.hpp"

namespace dipper::dem {

enum class Rest : std::uint8_t { moving, held, parked };

/// The state of a rock at a check; bits, so that ranks can be joined by a bitwise or.
namespace rest_flag {
inline constexpr std::uint8_t busy = 1;       ///< too fast to be at rest
inline constexpr std::uint8_t near = 2;       ///< a moving wall is within the margin
inline constexpr std::uint8_t soon = 4;       ///< or will be
inline constexpr std::uint8_t disturbed = 8;  ///< held, and its load has changed
inline constexpr std::uint8_t struck = 16;    ///< the same, and cannot wait for the next check
inline constexpr std::uint8_t exposed = 32;   ///< at rest, within reach of a rock that moves
}  // namespace rest_flag

/// A body's box now, and where it will be if it keeps its velocity.
class WallZone {
 public:
  /// \param box  in the body's frame
  /// \param ahead_s  0 for now only; the way there is sampled so that samples overlap
  WallZone(const Box& box, const Pose& X_WB, const Twist& V_WB_W, double ahead_s, double margin_m);
  bool holds(const Vector3d& p_W, double radius_m) const;

 private:
  std::vector<Pose> X_BW_;
  Box box_;       ///< with the margin, in the body's frame
  Box around_W_;  ///< all samples of it: most rock is far away and needs no change of frame
};

/// A sphere of moving rock and its clearance.
struct Mover {
  double x, y, z, radius_m, gap_m;
};

/// Finds what is within the gap of a mover. Movers are sorted into cells half as wide as the
/// largest reach, x running fastest; a query checks the rows of five around its cell, unless all of
/// them are known to be empty.
class Reach {
 public:
  /// \param largest_m  radius of the largest sphere in any query
  Reach(std::vector<Mover> movers, double largest_m);
  bool touches(const Vector3d& p, double radius_m) const;

 private:
  static constexpr int kAround = 2;  ///< cells
  double cell(int axis, double x) const { return (x - box_.min_m[axis]) / cell_m_; }
  std::size_t at(int i, int j, int k) const {
    const int c = (k * cells_[1] + j) * cells_[0] + i;
    return static_cast<std::size_t>(c);
  }
  Box box_;  ///< of the movers' centres, with kAround cells more
  double cell_m_ = 1;
  int cells_[3] = {0, 0, 0};
  std::vector<std::uint32_t> first_;  ///< mover of each cell
  std::vector<char> near_;            ///< whether a mover is within kAround cells of it
  std::vector<Mover> movers_;         ///< cell by cell
};

/// The rules' data of one rock; the same on every rank, except flags until they are joined.
struct RestRecord {
  Rest rest = Rest::moving;
  std::uint8_t flags = 0;  ///< rest_flag: its state at this check
  float calm_s = 0;        ///< for how long it has been calm, while it moves
};

/// The state of every rock, by its number.
class HoldPolicy {
 public:
  HoldPolicy(const setup::HoldSettings& settings, std::size_t rocks)
      : settings_(settings), rocks_(rocks) {}

  Rest of(std::size_t rock) const { return rocks_[rock].rest; }
  std::vector<Rest> all() const;
  std::size_t size() const { return rocks_.size(); }

  void flag(std::size_t rock, std::uint8_t bits) { rocks_[rock].flags |= bits; }
  /// Clears all other bits of every rock's flags.
  void keep_flags(std::uint8_t bits);
  /// All flags, for joining them over ranks.
  std::vector<std::uint8_t> flags() const;
  void set_flags(const std::vector<std::uint8_t>& flags);

  /// Counts how long moving rock has been calm; `dt_s` since the last check.
  void observe(double dt_s);

  /// True when rock at rest must wake at once.
  bool alarms() const;

  /// Decides which rock moves and which is held: wakes rock that is near, soon near or disturbed;
  /// holds rock that has been calm for long enough.
  std::vector<Rest> decide() const;

  /// Splits the resting rock of `rest`: exposed rock is held, other rock parked.
  void park(std::vector<Rest>& rest) const;

  /// How many rocks differ.
  std::size_t changes(const std::vector<Rest>& rest) const;

  void adopt(const std::vector<Rest>& rest);

  /// The whole state, for a checkpoint.
  const std::vector<RestRecord>& records() const { return rocks_; }
  void restore(std::vector<RestRecord> records) { rocks_ = std::move(records); }

 private:
  setup::HoldSettings settings_;
  std::vector<RestRecord> rocks_;
};

}  // namespace dipper::dem
