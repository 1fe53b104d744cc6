#include "coupler/dry/estimated_rock.hpp"

#include <algorithm>
#include <cmath>

#include "common/gravity.hpp"
#include "coupler/deck/dig_planner.hpp"
#include "machine/cut_ahead.hpp"
#include "machine/door.hpp"
#include "machine/machine_data.hpp"

namespace dipper::dry {

DiggingEstimate digging_estimate(const cases::Case& c) {
  const machine::DigFacts facts = deck::dig_facts(c);
  const machine::MachineData::Dipper dipper = machine::load_machine(c.machine.model).dipper;
  DiggingEstimate e;
  e.bulk_density_kg_m3 = facts.bulk_density_kg_m3;
  e.capacity_kg = facts.capacity_kg;
  e.specific_resistance_Pa = facts.specific_resistance_Pa;
  e.lip_left_B = {dipper.inside.x() + dipper.tooth_reach, dipper.inside.y() / 2,
                  -dipper.inside.z() / 2};
  e.lip_right_B = e.lip_left_B - Vector3d(0, dipper.inside.y(), 0);
  e.load_B = facts.load_B;
  return e;
}

EstimatedRock::EstimatedRock(HeightMap bench, const DiggingEstimate& estimate, double timestep_s)
    : bench_(std::move(bench)),
      estimate_(estimate),
      tip_B_(0.5 * (estimate.lip_left_B + estimate.lip_right_B)),
      timestep_s_(timestep_s) {}

core::ServerInfo EstimatedRock::info() const {
  core::ServerInfo info;
  info.version = estimate_.there_is_rock ? "estimated rock (Dombrovskij's formula)" : "no rock";
  info.bodies = {"dipper", "door"};
  info.timestep_s = timestep_s_;
  info.channels = {{"mass_in_dipper", "kg", "-"}, {"mass_in_truck", "kg", "-"},
                   {"rock_mass", "kg", "-"},      {"particles", "1", "-"},
                   {"rocks", "1", "-"},           {"teeth_x", "m", "W"},
                   {"teeth_y", "m", "W"},         {"teeth_z", "m", "W"},
                   {"cut_depth", "m", "-"},       {"cut_resistance", "N", "-"}};
  return info;
}

core::RockState EstimatedRock::state() const {
  core::RockState s;
  s.step = step_;
  s.t_ns = step_ * std::llround(timestep_s_ * 1e9);
  s.bodies = {{load_, load_, X_WB_.at(0)}, {{}, {}, X_WB_.at(1)}};
  const Vector3d tip = X_WB_.at(0) * tip_B_;
  s.channels = {in_dipper_kg_, in_truck_kg_, 0,       0,        0,
                tip.x(),       tip.y(),      tip.z(), depth_m_, resistance_N_};
  return s;
}

core::RockState EstimatedRock::place(const std::vector<Pose>& X_WB) {
  X_WB_ = X_WB;
  return state();
}

core::RockState EstimatedRock::step(const core::RockStep& step) {
  if (estimate_.there_is_rock) {
    const Pose X_BD = inverse(step.X_WB_target.at(0)) * step.X_WB_target.at(1);
    if (machine::door_is_open(rotation_vector(X_BD.R).norm())) {
      in_truck_kg_ += in_dipper_kg_;
      in_dipper_kg_ = 0;
    }
    load_ = dig(X_WB_.at(0), step);
  }
  X_WB_ = step.X_WB_target;
  step_ += step.n_steps;
  return state();
}

Wrench EstimatedRock::dig(const Pose& from, const core::RockStep& step) {
  const DiggingEstimate& e = estimate_;
  const Pose& to = step.X_WB_target.at(0);
  const double window_s = static_cast<double>(step.n_steps) * timestep_s_;
  if (!step.contact) {
    depth_m_ = resistance_N_ = 0;
    return {};
  }
  const Vector3d tip_W = to * tip_B_;
  const machine::CutAhead ahead = machine::cut_ahead(bench_, to, e.lip_left_B, e.lip_right_B,
                                                     (tip_W - from * tip_B_) / window_s);
  depth_m_ = ahead.depth_m;
  resistance_N_ =
      ahead.meets ? e.specific_resistance_Pa * depth_m_ * (e.lip_left_B - e.lip_right_B).norm() : 0;
  const double cut_m3 =
      bench_.cut(from * e.lip_left_B, from * e.lip_right_B, to * e.lip_left_B, to * e.lip_right_B);
  in_dipper_kg_ = std::min(e.capacity_kg, in_dipper_kg_ + e.bulk_density_kg_m3 * cut_m3);

  const Vector3d push = -resistance_N_ * (to.R * Vector3d::UnitX());
  const Vector3d weight(0, 0, -in_dipper_kg_ * kGravity_m_s2);
  const Vector3d p_tip = tip_W - to.p, p_load = to * e.load_B - to.p;
  return {p_tip.cross(push) + p_load.cross(weight), push + weight};
}

HeightMap EstimatedRock::look(const HeightGrid& grid) { return bench_.on(grid); }

}  // namespace dipper::dry
