#include "dem/holding.hpp"

#include <lammps.h>
#include <update.h>

namespace dipper::dem {
namespace {

/// HoldRock holds the layer, too; with a layer alone no other rock comes to rest.
setup::HoldSettings settings_of(const setup::RockSetup& setup) {
  if (setup.hold) return *setup.hold;
  setup::HoldSettings layer_only;
  layer_only.below_m_s = 0;
  return layer_only;
}

}  // namespace

Holding::Holding(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup,
                 const std::vector<WallMotion*>& walls)
    : lmp_(lmp), setup_(setup), walls_(walls) {}

void Holding::measure_boxes() {
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    Box box = walls_[b]->box();
    for (const setup::Scale& s :
         setup_.scales) {  // rock that is weighed with a body is never parked
      if (s.body != setup_.bodies[b]) continue;
      box.add(s.box.min_m);
      box.add(s.box.max_m);
    }
    boxes_.push_back(box);
  }
}

void Holding::measure(const std::vector<Pose>&, std::vector<double>& parts) const {
  double mass = 0;
  for (const ParkedRock::Mass& m : parked()) mass += m.mass_kg;
  parts.push_back(mass);
}

void Holding::before_set_up() {
  if (setup_.layer) mark_layer(lmp_, *setup_.layer);
}

void Holding::release() {
  if (hold_) hold_->release();
  hold_.reset();  // it counts the rock at its start
}

void Holding::before_window(const RockWindow& window) {
  if (window.all_rock_in) return;
  if (!hold_) hold_ = std::make_unique<HoldRock>(lmp_, settings_of(setup_), lmp_.world);
  if (boxes_.empty()) measure_boxes();
  const double window_s = static_cast<double>(window.n_steps) * lmp_.update->dt;
  std::vector<MovingBody> bodies;
  for (std::size_t b = 0; b < boxes_.size(); ++b)
    bodies.push_back({boxes_[b], window.X_WB[b],
                      twist_between(window.X_WB[b], window.X_WB_target[b], window_s)});
  hold_->before_window(window.n_steps, bodies);
}

void Holding::save(ByteWriter& out) const {
  out.put(hold_ != nullptr);
  if (hold_) hold_->save(out);
}

void Holding::load(ByteReader& in) {
  hold_.reset();
  if (in.get<bool>()) hold_ = std::make_unique<HoldRock>(lmp_, settings_of(setup_), lmp_.world, in);
}

void Holding::wake_all() {
  if (hold_) hold_->release();
}

void Holding::hold_layer() {
  if (hold_) hold_->hold_layer();
}

const std::vector<ParkedRock::Mass>& Holding::parked() const {
  static const std::vector<ParkedRock::Mass> none;
  return hold_ ? hold_->parked() : none;
}

const std::vector<ParkedRock::Sphere>& Holding::parked_spheres() const {
  static const std::vector<ParkedRock::Sphere> none;
  return hold_ ? hold_->parked_spheres() : none;
}

}  // namespace dipper::dem
