#include "tests/mbs/rope.hpp"

#include "machine/sheave_path.hpp"

namespace dipper::mbs {

/// One end in space.
struct Rope::End {
  const SimTK::MobilizedBody& body;
  SimTK::Vec3 p_BE_G;  ///< body origin to the rope's end
  SimTK::Vec3 p_GE;
  SimTK::Vec3 toward_G;  ///< unit, along the rope
};

struct Rope::Path {
  double length;
  End a, b;
  SimTK::Vec3 p_SC_G;  ///< sheave body's origin to the sheave's centre
};

Rope::Rope(RopeSpec spec, std::function<FreeLength(const SimTK::State&)> free_length)
    : spec_(std::move(spec)), free_length_(std::move(free_length)) {}

Rope::Path Rope::path(const SimTK::State& state) const {
  const SimTK::Transform& X_GS = spec_.sheave_body.getBodyTransform(state);
  const auto end = [&](const SimTK::MobilizedBody& body, const SimTK::Vec3& station) {
    const SimTK::Transform& X_GB = body.getBodyTransform(state);
    const SimTK::Vec3 p_BE_G = X_GB.R() * station;
    return End{body, p_BE_G, X_GB.p() + p_BE_G, SimTK::Vec3(0)};
  };
  const auto in_plane = [&](const SimTK::Vec3& p_GE) {
    const SimTK::Vec3 p_S = ~X_GS.R() * (p_GE - X_GS.p()) - spec_.sheave_center;
    return Eigen::Vector2d(p_S[0], p_S[2]);
  };
  Path r{0, end(spec_.body_a, spec_.station_a), end(spec_.body_b, spec_.station_b),
         X_GS.R() * spec_.sheave_center};
  const machine::SheavePath plane =
      machine::sheave_path(in_plane(r.a.p_GE), in_plane(r.b.p_GE), spec_.sheave_radius);
  r.length = plane.length;
  r.a.toward_G = X_GS.R() * SimTK::Vec3(plane.toward_a.x(), 0, plane.toward_a.y());
  r.b.toward_G = X_GS.R() * SimTK::Vec3(plane.toward_b.x(), 0, plane.toward_b.y());
  return r;
}

RopeState Rope::evaluate(const SimTK::State& state) const { return evaluate(state, path(state)); }

RopeState Rope::evaluate(const SimTK::State& state, const Path& rope) const {
  // dl/dt: each end's velocity against the sheave's body, along the rope; moving the tangent
  // points does not change the length to first order.
  const SimTK::SpatialVec& V_GS = spec_.sheave_body.getBodyVelocity(state);
  const SimTK::Vec3& p_GS = spec_.sheave_body.getBodyTransform(state).p();
  double length_rate = 0;
  for (const End* e : {&rope.a, &rope.b}) {
    const SimTK::SpatialVec& V_GB = e->body.getBodyVelocity(state);
    const SimTK::Vec3 v_end = V_GB[1] + V_GB[0] % e->p_BE_G;
    const SimTK::Vec3 v_sheave = V_GS[1] + V_GS[0] % (e->p_GE - p_GS);
    length_rate -= SimTK::dot(e->toward_G, v_end - v_sheave);
  }
  return spec_.at(rope.length, length_rate, free_length_(state));
}

void Rope::calcForce(const SimTK::State& state, SimTK::Vector_<SimTK::SpatialVec>& body_forces,
                     SimTK::Vector_<SimTK::Vec3>&, SimTK::Vector&) const {
  const Path rope = path(state);
  const RopeState now = evaluate(state, rope);
  const double tension = now.tension;
  if (tension <= 0) return;
  SimTK::Vec3 on_sheave(0);
  for (const End* e : {&rope.a, &rope.b}) {
    const SimTK::Vec3 f_G = tension * e->toward_G;
    body_forces[e->body.getMobilizedBodyIndex()] += SimTK::SpatialVec(e->p_BE_G % f_G, f_G);
    on_sheave -= f_G;
  }
  // The two tangent forces have no moment about the sheave's axis: their resultant goes through it.
  body_forces[spec_.sheave_body.getMobilizedBodyIndex()] +=
      SimTK::SpatialVec(rope.p_SC_G % on_sheave, on_sheave);
}

double Rope::calcPotentialEnergy(const SimTK::State& state) const {
  return spec_.at(path(state).length, 0, free_length_(state)).elastic_energy;
}

}  // namespace dipper::mbs
