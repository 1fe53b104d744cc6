#include "coupler/deck/rock_kinds.hpp"

#include <algorithm>

#include "coupler/deck/contact_table.hpp"

namespace dipper::deck {

std::string kind_name(const cases::SizeClass& size, const std::string& shape) {
  return size.name + "_" + shape;
}

std::vector<RockKind> rock_kinds(const cases::Case& c,
                                 const std::map<std::string, RockShape>& shapes) {
  const std::vector<RockClass> classes = rock_classes(c);
  std::vector<RockKind> kinds;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const cases::SizeClass& s = c.rock.classes[i];
    const double size = 2 * classes[i].radius_m;
    for (const std::string& shape : s.shapes) {
      RockKind kind;
      kind.name = kind_name(s, shape);
      kind.mass_kg = classes[i].mass_kg;
      kind.mass_fraction = s.mass_percent / 100 / static_cast<double>(s.shapes.size());
      if (classes[i].is_sphere) {
        kind.spheres.push_back({Eigen::Vector3d::Zero(), classes[i].radius_m});
      } else {
        for (const Sphere& unit : shapes.at(shape).fit(c.rock.shape_resolution).spheres)
          kind.spheres.push_back({size * unit.centre_m, size * unit.radius_m});
      }
      for (const Sphere& sphere : kind.spheres)
        kind.reach_m = std::max(kind.reach_m, sphere.centre_m.norm() + sphere.radius_m);
      kinds.push_back(std::move(kind));
    }
  }
  return kinds;
}

double largest_reach_m(const std::vector<RockKind>& kinds) {
  double reach = 0;
  for (const RockKind& kind : kinds) reach = std::max(reach, kind.reach_m);
  return reach;
}

}  // namespace dipper::deck
