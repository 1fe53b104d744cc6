// Two bodies in dem_in/bench/two_body.in, with the tables a case generates.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/deck/deck.hpp"
#include "tests/coupler/deck/liggghts_run.hpp"
#include "tests/coupler/deck/quick_case.hpp"
#include "tests/places.hpp"

namespace dipper::two_body {

/// As dem_in/bench/two_body.in numbers them.
enum Kind { sphere = 0, held = 1, rock = 2, wall = 3 };

/// Types of quick_case's tables.
enum Type { d200 = 1, d300 = 2, dipper = 6, ground = 7, truck = 8, sides = 9 };

/// True sizes and the paper's stiffness; each test sets the coefficients it is about.
inline cases::Case paper_case() {
  cases::Case c = deck::quick_case();
  c.rock.coarse_graining = 1;
  c.contact.normal_scale = 0.05;
  return c;
}

/// A body as the closed forms see it.
struct Body {
  Kind kind = sphere;
  double mass = 0;        ///< kg; of the whole rock
  double radius = 0;      ///< m, volume-equivalent: what Eq. 4 takes
  double contact = 0;     ///< m, of the sphere that touches; its centre is the body's
  double gyration = 0.4;  ///< I/(m contact^2)
};

/// Sphere of class 1, or a rock of class 2 that is round, so that it can roll: one sphere about its
/// centre of mass, and a small one inside.
inline Body body(const cases::Case& c, Kind kind, double gyration = 0.4) {
  const double r = c.rock.classes[kind == rock ? 1 : 0].size_m / 2;
  return {kind, c.rock.density_kg_m3 * 4 / 3 * M_PI * r * r * r, r, r, gyration};
}

/// K_n of Eqs. 4 and 5, by hand: equal bulk moduli; a wall is the limit of a large radius.
inline double normal_stiffness(const cases::Case& c, const Body& a, const Body* b) {
  const double k = c.rock.youngs_modulus_Pa / (3 * (1 - 2 * c.rock.poisson_ratio));
  const double k1r1 = k * a.radius;
  if (b == nullptr) return c.contact.normal_scale * k1r1;
  const double k2r2 = k * b->radius;
  return c.contact.normal_scale * k1r1 * k2r2 / (k1r1 + k2r2);
}

inline double effective_mass(const Body& a, const Body* b) {
  return b == nullptr ? a.mass : a.mass * b->mass / (a.mass + b->mass);
}

/// What the deck records of A, one vector a column.
struct Record {
  std::vector<double> t, x, z, vx, vz, wy;
};

struct Start {
  double gap = 1e-7;  ///< m, along z; negative: overlap
  double vx = 0, vz = 0, wy = 0;
  double gx = 0, gz = 0;
  double timestep = 1e-6;
  int steps = 0;
  int every = 1;
  int ground_type = ground;
};

/// Runs A against B, or against a wall when B is null.
inline Record run(const cases::Case& c, const Body& a, const Body* b, const Start& s) {
  const auto out = deck::fresh_folder("two_body");
  deck::write_deck(c, test::source() / "meshes/rocks", out / "deck");
  const Body& round = b != nullptr && b->kind == rock ? *b : a;
  std::ofstream(out / "rock.spheres")
      << fmt::format("0 0 0 {}\n0 0 0 {}\n", round.contact, round.contact / 2);
  const double inertia = round.gyration * round.mass * round.contact * round.contact;
  const auto type = [](const Body& x) { return x.kind == rock ? d300 : d200; };
  const Kind b_kind = b == nullptr ? wall : b->kind;
  std::string vars = fmt::format(
      "-var deck '{0}/deck' -var rock_file '{0}/rock.spheres' -var a {1:d} -var b {2:d} -var "
      "a_type "
      "{3:d} -var b_type {4:d} -var a_radius {5} -var b_radius {6} -var density {7} ",
      out.string(), static_cast<int>(a.kind), static_cast<int>(b_kind), static_cast<int>(type(a)),
      b == nullptr ? 1 : static_cast<int>(type(*b)), a.contact, b == nullptr ? 0.1 : b->contact,
      c.rock.density_kg_m3);
  vars += fmt::format("-var rock_mass {} -var rock_ix {} -var rock_iy {} -var rock_iz {} ",
                      round.mass, inertia, inertia, inertia);
  vars += fmt::format(
      "-var a_z {:.12g} -var b_z 0 -var a_vx {} -var a_vz {} -var a_wy {} -var gx {:.12g} -var gz "
      "{:.12g} ",
      a.contact + (b == nullptr ? 0 : b->contact) + s.gap, s.vx, s.vz, s.wy, s.gx, s.gz);
  vars += fmt::format("-var timestep {} -var steps {} -var every {} -var ground_type {}",
                      s.timestep, s.steps, s.every, s.ground_type);
  if (deck::run_liggghts("dem_in/bench/two_body.in", vars, 1, out) != 0)
    throw std::runtime_error(deck::read_text(out / "screen.txt"));
  std::ifstream in(out / "record.txt");
  std::string title;
  std::getline(in, title);
  Record r;
  for (double t = 0, x = 0, z = 0, vx = 0, vz = 0, wy = 0; in >> t >> x >> z >> vx >> vz >> wy;) {
    r.t.push_back(t);
    r.x.push_back(x);
    r.z.push_back(z);
    r.vx.push_back(vx);
    r.vz.push_back(vz);
    r.wy.push_back(wy);
  }
  if (r.t.size() <= 10) throw std::runtime_error(deck::read_text(out / "screen.txt"));
  return r;
}

}  // namespace dipper::two_body
