#include "coupler/dry/estimated_rock.hpp"

#include <algorithm>
#include <cmath>

#include "common/gravity.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/sides/sides_setup.hpp"
#include "machine/door.hpp"
#include "machine/machine_data.hpp"

namespace dipper::dry {
namespace {

constexpr double kSpecificResistance_Pa = 0.38e6;  // docs/dry_run.md
constexpr double kStill_m_s = 1e-3;
constexpr double kSteepest_rad = 0.7;  // of a face: steeper is the side of the cut itself

/// Which way the floor goes from heel to teeth.
Vector3d forward(const Pose& X_WB) { return X_WB.R * Vector3d::UnitX(); }

}  // namespace

DiggingEstimate digging_estimate(const cases::Case& c) {
  const cases::DipperFacts facts = sides::read_mesh_facts(c).dipper;
  const machine::MachineData::Dipper dipper = machine::load_machine(c.machine.model).dipper;
  DiggingEstimate e;
  e.bulk_density_kg_m3 = c.rock.bulk_density_kg_m3 * deck::laden_density(c) / c.rock.density_kg_m3;
  e.capacity_kg = e.bulk_density_kg_m3 * facts.struck_volume_m3;
  e.specific_resistance_Pa = kSpecificResistance_Pa;
  e.lip_left_B = {dipper.inside.x() + dipper.tooth_reach, dipper.inside.y() / 2,
                  -dipper.inside.z() / 2};
  e.lip_right_B = e.lip_left_B - Vector3d(0, dipper.inside.y(), 0);
  e.load_B = 0.5 * (facts.cavity.min_m + facts.cavity.max_m);
  return e;
}

EstimatedRock::EstimatedRock(CutBench bench, const DiggingEstimate& estimate, double timestep_s)
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
  resistance_N_ = resistance(to, (tip_W - from * tip_B_) / window_s);
  const double cut_m3 =
      bench_.cut(from * e.lip_left_B, from * e.lip_right_B, to * e.lip_left_B, to * e.lip_right_B);
  in_dipper_kg_ = std::min(e.capacity_kg, in_dipper_kg_ + e.bulk_density_kg_m3 * cut_m3);

  const Vector3d push = -resistance_N_ * forward(to);
  const Vector3d weight(0, 0, -in_dipper_kg_ * kGravity_m_s2);
  const Vector3d p_tip = tip_W - to.p, p_load = to * e.load_B - to.p;
  return {p_tip.cross(push) + p_load.cross(weight), push + weight};
}

double EstimatedRock::resistance(const Pose& X_WB, const Vector3d& v_W) {
  const DiggingEstimate& e = estimate_;
  depth_m_ = 0;
  const Vector3d tip = X_WB * tip_B_;
  const Vector3d ahead = forward(X_WB);
  const Vector3d level = Vector3d(ahead.x(), ahead.y(), 0).normalized();
  // In the next cell: this one is cut. And the surface's slope from there to a metre on.
  constexpr double kNext_m = 1.5 * CutBench::kCell_m, kOn_m = 1;
  const auto surface = [&](double on_m) {
    const Vector3d p = tip + on_m * level;
    return bench_.height(p.x(), p.y());
  };
  const double slope = std::clamp(std::atan2(surface(kNext_m + kOn_m) - surface(kNext_m), kOn_m),
                                  0.0, kSteepest_rad);
  depth_m_ = std::max(0.0, (surface(kNext_m) - tip.z()) * std::cos(slope));
  if (depth_m_ == 0 || v_W.norm() < kStill_m_s || v_W.dot(ahead) < 0) return 0;
  return e.specific_resistance_Pa * depth_m_ * (e.lip_left_B - e.lip_right_B).norm();
}

}  // namespace dipper::dry
