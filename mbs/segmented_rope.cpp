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
constexpr double kStablePhase = 1.0;  // omega h; Runge-Kutta 3 takes 1.7

}  // namespace

SegmentedRope::SegmentedRope(const SegmentedRopeSpec& spec)
    : spec_(spec), part_(kBelow / spec.elements) {
  node_mass_ = spec.mass_per_length * element_length(spec.longest);
  if (spec.elements < 2 || !(node_mass_ > 0))
    throw std::invalid_argument("a segmented rope must have at least two elements, and mass");
}

double SegmentedRope::element_stiffness(double free_length) const {
  return spec_.elements * spec_.law.axial_stiffness / (spec_.law.elastic_fraction * free_length);
}

double SegmentedRope::longest_step() const {
  return kStablePhase / (2 * std::sqrt(element_stiffness(spec_.shortest) / node_mass_));
}

Vector2d SegmentedRope::lower(int i, const Numbers& nodes, const Vector2d& end) const {
  return i < spec_.elements - 1 ? Vector2d(nodes.segment<2>(2 * i)) : end;
}

SegmentedRope::Element SegmentedRope::element(int i, const Numbers& nodes, const Vector2d& end,
                                              double free_length) const {
  const double length = element_length(free_length);
  const Vector2d below = lower(i, nodes, end);
  if (i == 0) {
    const machine::SheavePath path = machine::sheave_path(spec_.drum, below, spec_.radius);
    return {path.length - (free_length - (spec_.elements - 1) * length), path.free_b,
            path.toward_b};
  }
  const Vector2d along = lower(i - 1, nodes, end) - below;
  const double distance = along.norm();
  return {distance - length, distance, along / distance};
}

SegmentedRope::Now SegmentedRope::at(const Numbers& nodes, const Vector2d& end,
                                     const Vector2d& end_rate, const FreeLength& free,
                                     const Vector2d& gravity) const {
  const int n = spec_.elements, n_nodes = n - 1;
  const double length_rate = part_ * free.rate;
  const double stiffness = element_stiffness(free.length);
  const double damping = 2 * kOwnDamping * std::sqrt(stiffness * node_mass_);
  const auto speed = [&](int i) -> Vector2d {
    return i < n_nodes ? Vector2d(nodes.segment<2>(2 * (n_nodes + i))) : end_rate;
  };
  std::vector<Element> elements;
  std::vector<double> stretch_rates;
  elements.reserve(static_cast<std::size_t>(n));
  stretch_rates.reserve(static_cast<std::size_t>(n));
  double all_rates = 0;
  Now now{};
  for (int i = 0; i < n; ++i) {
    const Element e = element(i, nodes, end, free.length);
    const double rate = i == 0 ? -e.up.dot(speed(i)) - (free.rate - n_nodes * length_rate)
                               : e.up.dot(speed(i - 1) - speed(i)) - length_rate;
    elements.push_back(e);
    stretch_rates.push_back(rate);
    now.state.stretch += e.stretch;
    all_rates += rate;
  }
  now.state.stretch_rate = all_rates;
  now.rates.resize(size());
  now.rates.head(2 * n_nodes) = nodes.tail(2 * n_nodes);
  double tension_sum = 0;
  for (int i = 0; i < n; ++i) {
    const Element& e = elements[static_cast<std::size_t>(i)];
    const double rate = stretch_rates[static_cast<std::size_t>(i)];
    double tension = 0;
    if (e.stretch > 0) {
      const double elastic = stiffness * e.stretch;
      tension = std::max(0.0, elastic + damping * rate + spec_.law.damping * all_rates);
      now.state.elastic_energy += 0.5 * elastic * e.stretch;
      now.state.dissipation += (tension - elastic) * rate;
    }
    const Vector2d force = tension * e.up;
    if (i < n_nodes) now.rates.segment<2>(2 * (n_nodes + i)) = force / node_mass_ + gravity;
    if (i > 0) now.rates.segment<2>(2 * (n_nodes + i - 1)) -= force / node_mass_;
    if (i == 0) now.state.tension = tension;
    if (i == n - 1) now.pull = force;
    tension_sum += tension;
  }
  // Paying out rope lengthens every element by its share, and softens it.
  now.state.winch_pull = (1 - n * part_) * now.state.tension + part_ * tension_sum +
                         now.state.elastic_energy / free.length;
  now.state.winch_power = -now.state.winch_pull * free.rate;
  now.potential = now.state.elastic_energy;
  for (int i = 0; i < n_nodes; ++i) {
    now.kinetic += 0.5 * node_mass_ * speed(i).squaredNorm();
    now.potential -= node_mass_ * gravity.dot(lower(i, nodes, end));
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
    const double enough = round > 50 ? 1e-9 : 1e-12;  // m
    if (force.cwiseAbs().maxCoeff() < enough * stiffness / node_mass_) return nodes;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n_nodes, 2 * n_nodes);
    for (int i = 0; i < n; ++i) {
      const Element e = element(i, nodes, end, free_length);
      const Eigen::Matrix2d along = e.up * e.up.transpose();
      const Eigen::Matrix2d across = Eigen::Matrix2d::Identity() - along;
      const Eigen::Matrix2d k =
          stiffness / node_mass_ * (along + std::max(e.stretch, 0.0) / e.reach * across);
      if (i < n_nodes) K.block<2, 2>(2 * i, 2 * i) += k;
      if (i > 0) K.block<2, 2>(2 * (i - 1), 2 * (i - 1)) += k;
      if (i > 0 && i < n_nodes) {
        K.block<2, 2>(2 * i, 2 * (i - 1)) -= k;
        K.block<2, 2>(2 * (i - 1), 2 * i) -= k;
      }
    }
    nodes.head(2 * n_nodes) += K.partialPivLu().solve(force);
  }
  throw std::runtime_error("the hoist rope has no equilibrium");
}

}  // namespace dipper::mbs
