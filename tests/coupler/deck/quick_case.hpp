// The case dem_in/default is generated from: a bench like that of tests/coupler/case/narrow, with
// all of Table 1 at twice its size, and paths seen from the repository.
#pragma once

#include "coupler/case/case.hpp"

namespace dipper::deck {

inline cases::Case quick_case() {
  const std::vector<std::string> angular = {"block", "wedge", "slab"};
  cases::Case c;
  c.seed = 1;
  c.rock.density_kg_m3 = 3215;  // so that bulk is 1903, as the paper scales it
  c.rock.youngs_modulus_Pa = 45e9;
  c.rock.poisson_ratio = 0.3;
  c.rock.coarse_graining = 2.0;
  c.rock.classes = {{"d200", 0.20, 37, {"sphere"}},
                    {"d300", 0.30, 10, angular},
                    {"d400", 0.40, 9, angular},
                    {"d600", 0.60, 19, angular},
                    {"d850", 0.85, 25, angular}};
  c.contact.normal_scale = 0.01;
  c.contact.tangential_scale = 0.27;
  c.contact.normal_damping = 0.9;
  c.contact.tangential_damping = 0.75;
  c.contact.friction_sphere_sphere = 0.9;
  c.contact.friction_sphere_rock = 0.85;
  c.contact.friction_rock_rock = 0.85;
  c.contact.friction_dipper = 0.53;
  c.contact.friction_ground = 0.9;
  c.contact.friction_truck = 0.9;
  c.contact.rolling_friction_sphere = 0.2;  // so that the pile stands at 35 degrees
  c.contact.rolling_friction_ground = 0.3;
  c.pile.toe_x_m = 13;
  c.pile.height_m = 8;
  c.pile.width_m = 8;
  c.pile.crest_depth_m = 2;
  c.pile.face_angle_deg = 35;
  c.pile.settle_s = 2.5;
  c.pile.relax_s = 3;
  c.bodies = {{"dipper", "meshes/dipper.stl"}, {"door", "meshes/door.stl"}};
  c.truck.mesh = "meshes/truck.stl";
  c.truck.position_m = {0, 18, 0};
  c.truck.heading_deg = 0;
  c.domain.min_m = {-12, -28, -1};
  c.domain.max_m = {32, 28, 24};
  c.dem.timestep_s = 3e-4;
  c.dem.ranks = 2;
  return c;
}

/// The same with a bench of a few hundred rocks, for runs of seconds.
inline cases::Case tiny_case() {
  cases::Case c = quick_case();
  c.rock.classes = {{"d200", 0.20, 60, {"sphere"}},
                    {"d300", 0.30, 25, {"block", "wedge"}},
                    {"d400", 0.40, 15, {"slab"}}};
  c.pile.height_m = 3;
  c.pile.width_m = 4;
  c.pile.crest_depth_m = 1;
  c.pile.settle_s = 1.5;
  c.pile.relax_s = 0.5;
  return c;
}

}  // namespace dipper::deck
