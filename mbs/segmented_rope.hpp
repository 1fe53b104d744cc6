// A hoist rope as in the paper: rigid from the drum over the sheave, elements with mass below.
#pragma once

#include <Eigen/Core>

#include "mbs/rope_law.hpp"

namespace dipper::mbs {

/// In the plane of the boom: x out, z up, from the sheave's centre, m.
struct SegmentedRopeSpec {
  Eigen::Vector2d drum{0, 0};  ///< where it leaves the drum
  double radius = 0;           ///< m, of the sheave
  RopeLaw law;
  int elements = 19;
  double mass_per_length = 0;  ///< kg/m
  double over = 0;             ///< m of rope from the drum over the sheave
  double longest = 0;          ///< m of free length, whose elements set the nodes' mass
  double shortest = 0;         ///< m of free length, whose elements set the longest step
};

/// n elements in line, free to turn, tension only, with a mass at each of the n - 1 nodes between
/// them. Of the free length L a part lies over the sheave; nine tenths of the rest are cut into n
/// equal elements, of which the first reaches up to the drum, so that no node reaches the sheave.
/// They stretch together as the elastic rope does, k = n EA / (f L) each, and in line with its
/// damping c on the rate at which the whole of it stretches, S; each has 5 % of critical of its
/// own, c_e, against its node's mass:
///   T = max(0, k s + c_e ds/dt + c dS/dt) where s > 0, and 0 where s <= 0.
/// Gravity acts on the nodes; the house's swing does not.
class SegmentedRope {
 public:
  using Numbers = Eigen::VectorXd;  ///< n - 1 positions (x, z), then as many velocities

  explicit SegmentedRope(const SegmentedRopeSpec& spec);

  struct Now {
    RopeState state;            ///< its tension is that at the sheave
    Eigen::Vector2d pull;       ///< N, on the lower end
    double kinetic, potential;  ///< J, the potential with its elastic energy, 0 at the sheave
    Numbers rates;
  };
  /// \param end, end_rate  the lower end, m, m/s
  /// \param gravity        m/s^2
  Now at(const Numbers& nodes, const Eigen::Vector2d& end, const Eigen::Vector2d& end_rate,
         const FreeLength& free, const Eigen::Vector2d& gravity) const;

  /// The nodes at rest, for a taut rope. Throws std::runtime_error if there is no equilibrium.
  Numbers settled(const Eigen::Vector2d& end, double free_length,
                  const Eigen::Vector2d& gravity) const;

  /// The longest step at which Runge-Kutta 3 is stable, with a margin; s.
  double longest_step() const;
  int size() const { return 4 * (spec_.elements - 1); }
  double node_mass() const { return node_mass_; }

 private:
  /// An element: its stretch, and its direction up and length below the sheave.
  struct Element {
    double stretch, reach;
    Eigen::Vector2d up;  ///< unit, from its lower node
  };
  Element element(int i, const Numbers& nodes, const Eigen::Vector2d& end,
                  double free_length) const;
  /// The lower node of an element, of the last one the rope's end.
  Eigen::Vector2d lower(int i, const Numbers& nodes, const Eigen::Vector2d& end) const;
  double element_stiffness(double free_length) const;
  double element_length(double free_length) const { return part_ * (free_length - spec_.over); }

  SegmentedRopeSpec spec_;
  double part_;  ///< of the rope below the sheave that is one element
  double node_mass_;
};

}  // namespace dipper::mbs
