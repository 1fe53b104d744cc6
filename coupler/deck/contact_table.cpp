#include "coupler/deck/contact_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/fines.hpp"

namespace dipper::deck {
namespace {

struct Pair {
  double kn, meff, friction, rolling;
  bool spheres = false;  // both of them
};

double damping(double share_of_critical, double stiffness, double meff) {
  return 2 * share_of_critical * std::sqrt(stiffness / meff);
}

}  // namespace

double porosity(const cases::Case& c) {
  return std::max(0.0, 1 - c.rock.bulk_density_kg_m3 / c.rock.density_kg_m3);
}

double laden_density(const cases::Case& c) {
  return with_fines(c.rock.density_kg_m3, c.rock.fines_fraction, porosity(c));
}

double pull_off_stress(double tensile_strength_Pa, double porosity) {
  return tensile_strength_Pa * porosity / (1 - porosity);
}

bool needs_cohesion_model(const cases::Case& c) {
  return c.contact.cohesion_Pa > 0 || c.contact.adhesion_Pa > 0 || c.crust.tensile_strength_Pa > 0;
}

double grained_size_m(const cases::RockCase& rock, double size_m) {
  const double grown = size_m * rock.coarse_graining, limit = rock.coarse_graining_limit_m;
  return limit > 0 ? std::min(grown, std::max(size_m, limit)) : grown;
}

std::vector<RockClass> rock_classes(const cases::Case& c) {
  std::vector<RockClass> out;
  for (const cases::SizeClass& s : c.rock.classes) {
    const auto spheres = std::count(s.shapes.begin(), s.shapes.end(), "sphere");
    if (s.shapes.empty() || (spheres != 0 && s.shapes.size() != 1))
      throw std::invalid_argument("rock.classes: " + s.name +
                                  ": shapes must be [sphere] or names of rock shapes");
    const double r = grained_size_m(c.rock, s.size_m) / 2;
    out.push_back({r, laden_density(c) * 4.0 / 3.0 * M_PI * r * r * r, spheres == 1});
  }
  return out;
}

AtomTypes atom_types(const cases::Case& c) { return {static_cast<int>(c.rock.classes.size())}; }

ContactTable contact_table(const cases::Case& c) {
  const std::vector<RockClass> rocks = rock_classes(c);
  const AtomTypes types = atom_types(c);
  const cases::ContactCase k = cases::of_every_pair(c.contact);
  const double bulk = c.rock.youngs_modulus_Pa / (3 * (1 - 2 * c.rock.poisson_ratio));

  ContactTable t;
  for (Eigen::MatrixXd* m :
       {&t.kn, &t.kt, &t.gamman, &t.gammat, &t.friction, &t.rolling, &t.meff_kg, &t.pull_off_Pa})
    m->setZero(types.count(), types.count());
  const auto set = [&](int a, int b, const Pair& p) {
    for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, a}}) {
      t.kn(i, j) = p.kn;
      t.kt(i, j) = k.tangential_scale * p.kn;
      t.gamman(i, j) =
          damping(p.spheres ? k.normal_damping : *k.normal_damping_other, p.kn, p.meff);
      t.gammat(i, j) = damping(p.spheres ? k.tangential_damping : *k.tangential_damping_other,
                               k.tangential_scale * p.kn, p.meff);
      t.friction(i, j) = p.friction;
      t.rolling(i, j) = p.rolling;
      t.meff_kg(i, j) = p.meff;
    }
  };

  for (int i = 0; i < types.classes; ++i) {
    const RockClass& a = rocks[static_cast<std::size_t>(i)];
    for (int j = i; j < types.classes; ++j) {
      const RockClass& b = rocks[static_cast<std::size_t>(j)];
      const double r1 = a.radius_m, r2 = b.radius_m;
      Pair p{k.normal_scale * bulk * r1 * r2 / (r1 + r2),
             a.mass_kg * b.mass_kg / (a.mass_kg + b.mass_kg), k.friction_rock_rock, 0};
      if (a.is_sphere && b.is_sphere) {
        p.spheres = true;
        p.friction = k.friction_sphere_sphere;
        p.rolling = k.rolling_friction_sphere * (1 + std::min(r1, r2) / std::max(r1, r2));
      } else if (a.is_sphere || b.is_sphere) {
        p.friction = k.friction_sphere_rock;
        p.rolling = *k.rolling_friction_rock * (a.is_sphere ? 1 + r1 / r2 : 1 + r2 / r1);
      }
      set(i, j, p);
    }
    const double kn = k.normal_scale * bulk * a.radius_m;
    const auto wall = [&](int type, double friction, double rolling) {
      set(i, type - 1, {kn, a.mass_kg, friction, a.is_sphere ? rolling : 0});
    };
    wall(types.dipper(), k.friction_dipper, *k.rolling_friction_dipper);
    wall(types.ground(), k.friction_ground, k.rolling_friction_ground);
    wall(types.truck(), a.is_sphere ? *k.friction_truck_sphere : k.friction_truck,
         *k.rolling_friction_truck);
    wall(types.sides(), 0, 0);
  }

  const int n = types.classes;
  const auto stress = [&](double strength) {
    return strength > 0 ? pull_off_stress(strength, porosity(c)) : 0.0;
  };
  t.pull_off_Pa.topLeftCorner(n, n).setConstant(stress(k.cohesion_Pa));
  for (const auto& [wall, strength] : {std::pair{types.ground(), k.cohesion_Pa},
                                       {types.dipper(), k.adhesion_Pa},
                                       {types.truck(), k.adhesion_Pa}}) {
    t.pull_off_Pa.col(wall - 1).head(n).setConstant(stress(strength));
    t.pull_off_Pa.row(wall - 1).head(n).setConstant(stress(strength));
  }
  return t;
}

}  // namespace dipper::deck
