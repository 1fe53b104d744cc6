#include "mbs/segmented_rope.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "machine/sheave_path.hpp"

namespace dipper::mbs {
namespace {

using Eigen::Vector2d;

constexpr double kBelow = 0.9;        // of the rope below the sheave: the elements
constexpr double kOwnDamping = 0.05;  // of critical
constexpr double kStablePhase = 2.0;  // omega h; Runge-Kutta 4 takes 2.8

}  // namespace

SegmentedRope::SegmentedRope(const SegmentedRopeSpec& spec)
    : spec_(spec), part_(kBelow / spec.elements) {
  node_mass_ = spec.mass_per_length * element_length(spec.longest);
  if (spec.elements < 2 || !(node_mass_ > 0))
    throw std::invalid_argument("a segmented rope has two elements at least, and mass");
}

double SegmentedRope::element_stiffness(double free_length) const {
  return spec_.elements * spec_.law.axial_stiffness / (spec_.law.elastic_fraction * free_length);
}

double SegmentedRope::longest_step() const {
  return kStablePhase / (2 * std::sqrt(element_stiffness(spec_.shortest) / node_mass_));
}

SegmentedRope::Now SegmentedRope::at(const Numbers& nodes, const Vector2d& end,
                                     const Vector2d& end_rate, const FreeLength& free,
                                     const Vector2d& gravity) const {
  const int n = spec_.elements, n_nodes = n - 1;
  const double length = element_length(free.length), length_rate = part_ * free.rate;
  const double stiffness = element_stiffness(free.length);
  const double damping = 2 * kOwnDamping * std::sqrt(stiffness * node_mass_);
  const auto place = [&](int i) -> Vector2d {
    return i < n_nodes ? Vector2d(nodes.segment<2>(2 * i)) : end;
  };
  const auto speed = [&](int i) -> Vector2d {
    return i < n_nodes ? Vector2d(nodes.segment<2>(2 * (n_nodes + i))) : end_rate;
  };
  struct Element {
    double stretch, rate;
    Vector2d up;  // unit, from its lower node
  };
  std::vector<Element> elements(static_cast<std::size_t>(n));
  double all_rates = 0;
  Now now{};
  for (int i = 0; i < n; ++i) {
    Element& e = elements[static_cast<std::size_t>(i)];
    const Vector2d lower = place(i), lower_rate = speed(i);
    if (i == 0) {
      const machine::SheavePath path = machine::sheave_path(spec_.drum, lower, spec_.radius);
      e.up = path.toward_b;
      e.stretch = path.length - (free.length - n_nodes * length);
      e.rate = -e.up.dot(lower_rate) - (free.rate - n_nodes * length_rate);
    } else {
      const Vector2d along = place(i - 1) - lower;
      const double distance = along.norm();
      e.up = along / distance;
      e.stretch = distance - length;
      e.rate = e.up.dot(speed(i - 1) - lower_rate) - length_rate;
    }
    now.state.stretch += e.stretch;
    all_rates += e.rate;
  }
  now.state.stretch_rate = all_rates;
  now.rates.resize(size());
  now.rates.head(2 * n_nodes) = nodes.tail(2 * n_nodes);
  double tension_sum = 0;
  for (int i = 0; i < n; ++i) {
    const Element& e = elements[static_cast<std::size_t>(i)];
    double tension = 0;
    if (e.stretch > 0) {
      const double elastic = stiffness * e.stretch;
      tension = std::max(0.0, elastic + damping * e.rate + spec_.law.damping * all_rates);
      now.state.elastic_energy += 0.5 * elastic * e.stretch;
      now.state.dissipation += (tension - elastic) * e.rate;
    }
    const Vector2d force = tension * e.up;
    if (i < n_nodes) now.rates.segment<2>(2 * (n_nodes + i)) = force / node_mass_ + gravity;
    if (i > 0) now.rates.segment<2>(2 * (n_nodes + i - 1)) -= force / node_mass_;
    if (i == 0) now.state.tension = tension;
    if (i == n - 1) now.pull = force;
    tension_sum += tension;
  }
  // Letting rope out lengthens every element by its part, and softens it.
  now.state.winch_pull = (1 - n * part_) * now.state.tension + part_ * tension_sum +
                         now.state.elastic_energy / free.length;
  now.state.winch_power = -now.state.winch_pull * free.rate;
  now.potential = now.state.elastic_energy;
  for (int i = 0; i < n_nodes; ++i) {
    now.kinetic += 0.5 * node_mass_ * speed(i).squaredNorm();
    now.potential -= node_mass_ * gravity.dot(place(i));
  }
  return now;
}

SegmentedRope::Numbers SegmentedRope::settled(const Vector2d& end, double free_length,
                                              const Vector2d& gravity) const {
  const int n = spec_.elements, n_nodes = n - 1;
  const FreeLength free{free_length, 0};
  const machine::SheavePath path = machine::sheave_path(spec_.drum, end, spec_.radius);
  // In line, all stretched alike.
  const double length = element_length(free_length) + (path.length - free_length) / n;
  Numbers nodes = Numbers::Zero(size());
  for (int i = 0; i < n_nodes; ++i)
    nodes.segment<2>(2 * i) = end + (n_nodes - i) * length * path.toward_b;
  // Newton, with the stiffness along each element and, by its tension, across it.
  const double stiffness = element_stiffness(free_length);
  for (int round = 0; round < 100; ++round) {
    const Numbers force = at(nodes, end, Vector2d::Zero(), free, gravity).rates.tail(2 * n_nodes);
    if (force.cwiseAbs().maxCoeff() < 1e-9 * stiffness / node_mass_) {
      if (force.cwiseAbs().maxCoeff() < 1e-12 * stiffness / node_mass_ || round > 50) return nodes;
    }
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n_nodes, 2 * n_nodes);
    for (int i = 0; i < n; ++i) {
      const Vector2d lower = i < n_nodes ? Vector2d(nodes.segment<2>(2 * i)) : end;
      Vector2d up;
      double distance, stretch;
      if (i == 0) {
        const machine::SheavePath p = machine::sheave_path(spec_.drum, lower, spec_.radius);
        up = p.toward_b;
        distance = p.free_b;
        stretch = p.length - (free_length - n_nodes * element_length(free_length));
      } else {
        const Vector2d along = Vector2d(nodes.segment<2>(2 * (i - 1))) - lower;
        distance = along.norm();
        up = along / distance;
        stretch = distance - element_length(free_length);
      }
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - up * up.transpose();
      const Eigen::Matrix2d k = stiffness / node_mass_ *
                                (up * up.transpose() + std::max(stretch, 0.0) / distance * across);
      if (i < n_nodes) K.block<2, 2>(2 * i, 2 * i) += k;
      if (i > 0) K.block<2, 2>(2 * (i - 1), 2 * (i - 1)) += k;
      if (i > 0 && i < n_nodes) {
        K.block<2, 2>(2 * i, 2 * (i - 1)) -= k;
        K.block<2, 2>(2 * (i - 1), 2 * i) -= k;
      }
    }
    nodes.head(2 * n_nodes) += K.partialPivLu().solve(force);
  }
  throw std::runtime_error("the hoist rope finds no rest");
}

}  // namespace dipper::mbs
