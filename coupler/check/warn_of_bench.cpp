#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "common/angles.hpp"
#include "common/gravity.hpp"
#include "coupler/case/bench_surface.hpp"
#include "coupler/check/warning_parts.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/pile_shape.hpp"

namespace dipper::check {
namespace {

constexpr double kSteep_deg = 60;  // as dipper survey: blasted rock rests at 30 to 45
constexpr double kSoft = 0.05;     // of a rock's diameter; cases here have some 0.005
constexpr double kStep = 0.25;     // of the height, at once at the toe or at one point
constexpr double kSlope = 1;       // steeper than 45 degrees on both sides no rock rests

/// The points beside one.
struct Beside {
  double low_m = INFINITY, high_m = -INFINITY, far_m = 0;

  void add(double z_m, double distance_m) {
    low_m = std::min(low_m, z_m);
    high_m = std::max(high_m, z_m);
    far_m = std::max(far_m, distance_m);
  }
};

/// The point farthest over or under all points beside it.
void warn_of_lone_point(const cases::Case& c, double top, std::vector<Finding>& warnings) {
  double most_m = kStep * top;
  std::string what;
  const auto weigh = [&](const Eigen::Vector3d& p, const Beside& beside) {
    const double off_m = std::max(p.z() - beside.high_m, beside.low_m - p.z());
    if (beside.far_m == 0 || off_m <= most_m || off_m < kSlope * beside.far_m) return;
    most_m = off_m;
    what = fmt::format(
        "the point at x = {:g}{} m is at {:g} m, those beside it at {:g} to {:g} m: is it a wrong "
        "reading{}? leave it out",
        p.x(), c.pile.surface ? fmt::format(", y = {:g}", p.y()) : "", p.z(), beside.low_m,
        beside.high_m, p.z() < beside.low_m ? ", or no data" : "");
  };
  if (c.pile.surface) {
    const mesh::TriangleMesh& mesh = c.pile.surface->mesh();
    std::vector<Beside> beside(mesh.vertices.size());
    for (const auto& t : mesh.triangles)
      for (const std::size_t i : t)
        for (const std::size_t j : t)
          if (const Eigen::Vector3d& a = mesh.vertices[i], &b = mesh.vertices[j]; i != j)
            beside[i].add(b.z(), (b - a).head<2>().norm());
    for (std::size_t i = 0; i < beside.size(); ++i) weigh(mesh.vertices[i], beside[i]);
  } else {
    const auto& outline = c.pile.outline_m;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
      Beside beside;
      for (const std::size_t j : {i - 1, i + 1})
        beside.add(outline[j].y(), std::abs(outline[j].x() - outline[i].x()));
      weigh({outline[i].x(), 0, outline[i].y()}, beside);
    }
  }
  if (!what.empty()) warnings.push_back({c.pile.profile, 0, "pile.profile", what});
}

/// How far the lowest rock overlaps under the bench's weight, as a share of its diameter d. Of
/// spheres of density rho with z contacts each, packed to the share s of the volume, a stress p
/// gives each contact F = p pi d^2 / (z s), and K_n = C K d / 4 (contact_table.hpp).
double overlap(const cases::Case& c, double top_m) {
  constexpr double kContactsOfOne = 5;
  const double solid = c.rock.bulk_density_kg_m3 / c.rock.density_kg_m3;
  const double stress_Pa = c.rock.bulk_density_kg_m3 * kGravity_m_s2 * top_m;
  const double bulk_Pa = c.rock.youngs_modulus_Pa / (3 * (1 - 2 * c.rock.poisson_ratio));
  return 4 * M_PI * stress_Pa / (kContactsOfOne * solid * c.contact.normal_scale * bulk_Pa);
}

/// How long poured rock falls, which starts at 1 m/s (dem_in).
double falls_for_s(double height_m) {
  return (std::sqrt(1 + 2 * kGravity_m_s2 * std::max(0.0, height_m)) - 1) / kGravity_m_s2;
}

}  // namespace

void warn_of_bench(const cases::Case& c, std::vector<Finding>& warnings) {
  const auto& outline = c.pile.outline_m;
  double top = c.pile.profile.empty() ? c.pile.height_m : 0;
  for (const auto& p : outline) top = std::max(top, p.y());
  if (const double share = overlap(c, top); share > kSoft)
    warnings.push_back(cases::finding_at(
        c, "contact.normal_scale",
        fmt::format("under the weight of the bench rocks overlap by {:.0f} % of their diameter; "
                    "write {:.1g} or more for {:.0f} %",
                    100 * share, c.contact.normal_scale * share / kSoft, 100 * kSoft)));
  const deck::PileShape pour = deck::pile_shape(c);
  const double fall_s = falls_for_s(pour.pour_height_m - pour.height_m);
  if (c.pile.built == cases::PileBuilt::poured && c.pile.settle_s > 0 && c.pile.settle_s < fall_s)
    warnings.push_back(cases::finding_at(
        c, "pile.settle_s",
        fmt::format("in {:g} s the poured rock has not come down, and the bench is cut from what "
                    "is still in the air; write {:.2g} or more",
                    c.pile.settle_s, fall_s + 1)));
  double smallest = INFINITY;
  for (const deck::RockClass& rock : deck::rock_classes(c))
    smallest = std::min(smallest, 2 * rock.radius_m);
  if (c.pile.held_layer_m > 0 && c.pile.held_layer_m < smallest)
    warnings.push_back(cases::finding_at(
        c, "pile.held_layer_m",
        fmt::format("{:g} m hold no rock: the smallest is {:g} m", c.pile.held_layer_m, smallest)));
  if (c.crust.tensile_strength_Pa > 0 && c.crust.thickness_m > 0 && c.crust.thickness_m < smallest)
    warnings.push_back(cases::finding_at(c, "crust.thickness_m",
                                         fmt::format("{:g} m bond no rocks: the smallest is {:g} m",
                                                     c.crust.thickness_m, smallest)));
  if (const double x = c.pile.clean_floor_to_x_m; x != 0) {
    const double high = cases::outline_height(deck::bench_outline(c), x);
    if (high > smallest)
      warnings.push_back(cases::finding_at(
          c, "pile.clean_floor_to_x_m",
          fmt::format(
              "at {:g} m the bench is {:.2g} m high, and its foot would be removed with the "
              "rock on the floor; write less than {:.3g}",
              x, high, pour.toe_x_m)));
  }
  if (const double layer = c.pile.held_layer_m;
      layer > 0 && (layer >= top || layer >= c.pile.width_m / 2))
    warnings.push_back(cases::finding_at(
        c, "pile.held_layer_m",
        fmt::format("{:g} m hold all rock of a bench {:.3g} m high and {:g} m wide", layer, top,
                    c.pile.width_m)));
  if (c.pile.settle_s == 0 && c.pile.relax_s == 0)
    warnings.push_back(
        cases::finding_at(c, "pile.settle_s",
                          "with pile.relax_s 0 as well the pile is not settled: rock is poured "
                          "and falls as the run begins"));
  if (c.crust.tensile_strength_Pa > 0 && top > 0 && c.crust.above_m >= top)
    warnings.push_back(cases::finding_at(
        c, "crust.above_m",
        fmt::format("is {:g} m, not below the top of the bench, {:.3g} m: no rock is bonded",
                    c.crust.above_m, top)));
  const auto steep = [](double angle_deg) {
    return fmt::format("the face stands at {:.0f} degrees, and blasted rock rests at 30 to 45",
                       angle_deg);
  };
  if (c.pile.profile.empty() && c.pile.face_angle_deg > kSteep_deg)
    warnings.push_back(cases::finding_at(c, "pile.face_angle_deg", steep(c.pile.face_angle_deg)));
  if (c.pile.profile.empty() || outline.size() < 2) return;
  const auto say = [&](const std::string& what) {
    warnings.push_back({c.pile.profile, 0, "pile.profile", what});
  };
  warn_of_lone_point(c, top, warnings);
  if (!c.pile.surface && outline.front().y() > kStep * top)
    return say(
        fmt::format("begins with a step of {:.2g} m at the toe, x = {:g} m: is the foot of "
                    "the face missing?",
                    outline.front().y(), outline.front().x()));
  const auto first_above = [&](double share) {
    return std::find_if(outline.begin(), outline.end(),
                        [&](const auto& p) { return p.y() >= share * top; });
  };
  auto low = first_above(0.25);
  const auto high = first_above(0.75);
  if (low == outline.end() || high == outline.end()) return;
  if (low == high && low != outline.begin()) --low;  // one segment holds both
  if (low == high) return;
  const double angle = degrees(std::atan2(high->y() - low->y(), high->x() - low->x()));
  if (angle > kSteep_deg) say(steep(angle) + ": are the heights in another unit than x?");
}

}  // namespace dipper::check
