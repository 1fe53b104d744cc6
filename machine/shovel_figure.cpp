#include "machine/shovel_figure.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/mesh/solids.hpp"
#include "machine/sheave_path.hpp"

namespace dipper::machine {
namespace {

using mesh::append;
using mesh::block;
using mesh::both_sides;
using mesh::plate;
using mesh::rod;
using mesh::TriangleMesh;
using mesh::turned;

constexpr std::size_t kRound = 20;    // sides of round parts
constexpr std::size_t kWrapped = 12;  // points of a rope where it lies on its sheave

/// Lengths that the data does not have, as shares of the winch's height above ground, u, estimated
/// from general arrangement drawings of the class. None affects a run.
class Frame {
 public:
  explicit Frame(const MachineData& machine)
      : u(machine.rope.drum.z()),
        tip(machine.boom.point.x(), machine.boom.point.z()),
        tube(0.085 * u) {
    const Vector2d saddle(machine.saddle.position.x(), machine.saddle.position.z());
    along = (tip - saddle).normalized();
    up = {-along.y(), along.x()};
    if (!(u > 0) || !(along.y() > 0.1))
      throw std::invalid_argument(
          "a shovel is drawn with its winch above ground and its boom's point above the saddle");
    foot = tip - (tip.y() - 0.6 * u) / along.y() * along;
    boom = (tip - foot).norm();
  }

  /// A point of the boom's side: a share of its length from the foot, and metres up from its
  /// middle.
  Vector2d at(double share, double height) const {
    return foot + share * boom * along + height * up;
  }

  double u;
  Vector2d tip, foot, along, up;  // of the boom, in x and z of H
  double boom;                    // m long
  double tube;                    // radius of the handle, m
};

std::vector<FigurePart> ground_parts(const Frame& f) {
  const double u = f.u, h = 0.33 * u, half = 0.82 * u;
  // A crawler's side: flat below, round at both ends.
  std::vector<Vector2d> side;
  for (const double end : {1.0, -1.0})
    for (int k = -4; k <= 4; ++k) {
      const double a = end > 0 ? k * M_PI / 8 : M_PI + k * M_PI / 8;
      side.emplace_back(end * (half - h / 2) + h / 2 * std::cos(a), h / 2 + h / 2 * std::sin(a));
    }
  TriangleMesh wheels;
  for (int k = -3; k <= 3; ++k)
    append(wheels, turned({{0.02 * h, 0.425 * u},
                           {0.02 * h, 0.755 * u},
                           {0.3 * h, 0.755 * u},
                           {0.3 * h, 0.425 * u}},
                          {k * 0.21 * u, 0, 0.42 * h}, 12));
  TriangleMesh body = block({-0.5 * u, -0.45 * u, 0.14 * u}, {0.5 * u, 0.45 * u, 0.36 * u});
  std::vector<Eigen::Vector3d> low, high;
  for (std::size_t k = 0; k < kRound; ++k) {
    const double a = 2 * M_PI * static_cast<double>(k) / kRound;
    low.emplace_back(0.45 * u * std::cos(a), 0.45 * u * std::sin(a), 0.36 * u);
    high.emplace_back(low.back() + Vector3d(0, 0, 0.09 * u));
  }
  append(body, mesh::prism(low, high));
  return {{"crawlers", both_sides(plate(side, 0.44 * u, 0.74 * u))},
          {"rollers", both_sides(wheels)},
          {"car body", body}};
}

std::vector<FigurePart> upper_parts(const Frame& f) {
  const double u = f.u;
  const Vector3d apex(-0.3 * u, 0.26 * u, 2.0 * u);
  TriangleMesh gantry = rod({{0.34 * u, 0.3 * u, 0.55 * u}, apex}, 0.045 * u, 8);  // in compression
  append(gantry, rod({{-1.05 * u, 0.3 * u, 0.55 * u}, apex}, 0.03 * u, 8));        // holds it back
  const Vector2d hung = f.at(0.985, 0.02 * u);
  TriangleMesh pendants = rod({apex, {hung.x(), 0.12 * u, hung.y()}}, 0.012 * u, 6);
  TriangleMesh top = rod({apex, {apex.x(), -apex.y(), apex.z()}}, 0.045 * u, 8);
  append(top, both_sides(gantry));
  return {{"deck", block({-1.3 * u, -0.68 * u, 0.45 * u}, {0.5 * u, 0.68 * u, 0.55 * u})},
          {"house", plate({{-1.2 * u, 0.55 * u},
                           {0.06 * u, 0.55 * u},
                           {0.06 * u, 1.17 * u},
                           {-0.04 * u, 1.27 * u},
                           {-1.2 * u, 1.27 * u}},
                          -0.6 * u, 0.6 * u)},
          {"counterweight", plate({{-1.52 * u, 0.5 * u},
                                   {-1.2 * u, 0.45 * u},
                                   {-1.2 * u, 1.05 * u},
                                   {-1.52 * u, 0.95 * u}},
                                  -0.6 * u, 0.6 * u)},
          {"cab", block({0.1 * u, -0.66 * u, 0.84 * u}, {0.48 * u, -0.34 * u, 1.22 * u})},
          {"cab foot", block({0.12 * u, -0.64 * u, 0.55 * u}, {0.46 * u, -0.36 * u, 0.84 * u})},
          {"window", block({0.3 * u, -0.665 * u, 0.98 * u}, {0.487 * u, -0.335 * u, 1.16 * u})},
          {"gantry", top},
          {"pendants", both_sides(pendants)}};
}

std::vector<FigurePart> boom_parts(const Frame& f, const MachineData& machine) {
  const double u = f.u, gap = 1.2 * f.tube;
  TriangleMesh boom =
      both_sides(plate({f.at(0, -0.07 * u), f.at(0.45, -0.13 * u), f.at(0.8, -0.1 * u),
                        f.at(0.8, 0.1 * u), f.at(0.45, 0.13 * u), f.at(0, 0.07 * u)},
                       gap, gap + 0.09 * u));
  append(boom, plate({f.at(0.76, -0.102 * u), f.at(0.98, -0.06 * u), f.at(0.98, 0.06 * u),
                      f.at(0.76, 0.102 * u)},
                     -gap, gap));
  append(boom,
         plate({f.at(0, -0.07 * u), f.at(0.1, -0.08 * u), f.at(0.1, 0.08 * u), f.at(0, 0.07 * u)},
               -gap, gap));
  const double R = machine.boom.sheave_radius, y = std::abs(machine.rope.drum.y()), w = 0.1 * R,
               r = 0.5 * R / 12;
  // A groove for the rope between two flanges.
  const std::vector<Vector2d> sheave = {{0.12 * R, -w}, {0.7 * R, -w / 2}, {R + 2 * r, -w},
                                        {R - r, 0},     {R + 2 * r, w},    {0.7 * R, w / 2},
                                        {0.12 * R, w}};
  TriangleMesh sheaves = turned(sheave, machine.boom.point + Vector3d(0, y, 0), 2 * kRound);
  TriangleMesh shaft = rod({machine.boom.point - Vector3d(0, y + 3 * w, 0),
                            machine.boom.point + Vector3d(0, y + 3 * w, 0)},
                           0.14 * R, 12);
  const Vector3d& s = machine.saddle.position;
  const double out = gap + 0.16 * u;
  append(shaft, rod({s - Vector3d(0, out, 0), s + Vector3d(0, out, 0)}, 0.06 * u, 16));
  return {{"boom", boom}, {"sheaves", both_sides(sheaves)}, {"shafts", shaft}};
}

/// The handle passes through the saddle at every crowd, and its mass is balanced about its middle
/// except for a heavier dipper end.
double handle_length(const MachineData& machine, const Frame& f) {
  return std::max(2.2 * std::abs(machine.handle.mass_center),
                  machine.handle.reach_at_zero_crowd + machine.limits.crowd_max + 0.15 * f.u);
}

std::vector<FigurePart> dipper_parts(const MachineData& machine, const Frame& f) {
  const MachineData::Dipper& d = machine.dipper;
  const double roof = d.inside.z() / 2, t = 0.5 * f.tube, y = std::abs(d.bail.y()),
               end = d.handle_end.x();
  // Two cheeks from the roof to the handle's end, and a pin through all three.
  TriangleMesh lugs = both_sides(plate({{end - 0.28 * d.inside.x(), roof},
                                        {end + 0.3 * d.inside.x(), roof},
                                        {end + t, d.handle_end.z() + t},
                                        {end - t, d.handle_end.z() + t}},
                                       f.tube, f.tube + 0.3 * t));
  append(lugs, rod({d.handle_end - Vector3d(0, 1.7 * f.tube, 0),
                    d.handle_end + Vector3d(0, 1.7 * f.tube, 0)},
                   0.6 * t, 12));
  // The bail: an arm on either side of the dipper, up to a beam that carries the ropes' pins.
  const double side = d.inside.y() / 2 + 0.4 * t;
  TriangleMesh bail = rod(
      {{d.bail.x(), y, d.bail.z()}, {d.bail.x(), side, d.bail.z()}, {d.bail.x(), side, 0.2 * roof}},
      0.3 * t, 8);
  append(bail,
         mesh::turned(
             {{0.1 * t, -0.5 * t}, {0.1 * t, 0.5 * t}, {0.6 * t, 0.5 * t}, {0.6 * t, -0.5 * t}},
             {d.bail.x(), y, d.bail.z()}, 16));
  TriangleMesh both = both_sides(bail);
  append(both, rod({{d.bail.x(), -y, d.bail.z()}, {d.bail.x(), y, d.bail.z()}}, 0.3 * t, 8));
  // The lip: a bar along the floor's edge, under the teeth's roots.
  const double floor = -roof, w = d.inside.y() / 2;
  TriangleMesh lip = plate({{d.inside.x() - 0.12 * d.inside.x(), floor - 0.05},
                            {d.inside.x() + 0.01, floor - 0.05},
                            {d.inside.x() + 0.01, floor + 0.06},
                            {d.inside.x() - 0.12 * d.inside.x(), floor + 0.02}},
                           -w, w);
  return {{"lugs", lugs}, {"bail", both}, {"lip", lip}};
}

}  // namespace

ShovelFigure shovel_figure(const MachineData& machine) {
  const Frame f(machine);
  ShovelFigure figure;
  figure.ground = ground_parts(f);
  figure.house = upper_parts(f);
  for (FigurePart& part : boom_parts(f, machine)) figure.house.push_back(std::move(part));
  const double t = f.tube;
  TriangleMesh saddle =
      both_sides(block({-1.6 * t, 1.0 * t, -1.4 * t}, {1.6 * t, 1.18 * t, 1.4 * t}));
  append(saddle, block({-1.6 * t, -1.0 * t, 1.02 * t}, {1.6 * t, 1.0 * t, 1.35 * t}));
  append(saddle, block({-1.6 * t, -1.0 * t, -1.35 * t}, {1.6 * t, 1.0 * t, -1.02 * t}));
  figure.saddle = {{"saddle", saddle}};
  const double length = handle_length(machine, f);
  TriangleMesh handle = rod({{-length, 0, 0}, {-0.6 * t, 0, 0}}, t, kRound);
  append(handle, block({-2.2 * t, -0.98 * t, -0.8 * t}, {0.5 * t, 0.98 * t, 0.8 * t}));
  figure.handle = {{"handle", handle}};
  figure.dipper = dipper_parts(machine, f);
  // Half as thick again as a rope of 1/16 of its sheave's radius, so that it is seen.
  figure.rope_radius = 0.75 * machine.boom.sheave_radius / 16;
  return figure;
}

std::vector<Vector3d> rope_way(const MachineData& machine, double side, const Vector3d& p_HL) {
  const double R = machine.boom.sheave_radius, y = side * std::abs(machine.rope.drum.y());
  const Vector2d centre(machine.boom.point.x(), machine.boom.point.z());
  const Vector2d a = Vector2d(machine.rope.drum.x(), machine.rope.drum.z()) - centre,
                 b = Vector2d(p_HL.x(), p_HL.z()) - centre;
  const SheavePath path = sheave_path(a, b, R);
  const Vector2d off = b + path.free_b * path.toward_b;
  const double last = std::atan2(off.y(), off.x());
  std::vector<Vector3d> way = {{machine.rope.drum.x(), y, machine.rope.drum.z()}};
  for (std::size_t k = 0; k < kWrapped; ++k) {  // clockwise, so from the larger angle
    const double angle = last + path.wrap * (1 - static_cast<double>(k) / (kWrapped - 1));
    const Vector2d p = centre + R * Vector2d(std::cos(angle), std::sin(angle));
    way.emplace_back(p.x(), y, p.y());
  }
  way.push_back(p_HL);
  return way;
}

}  // namespace dipper::machine
