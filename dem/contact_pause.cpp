#include "dem/contact_pause.hpp"

#include <comm.h>
#include <fix_wall_gran.h>
#include <fmt/core.h>
#include <integrate.h>
#include <lammps.h>
#include <modify.h>
#include <update.h>

#include <cmath>
#include <stdexcept>

#include "dem/wall_motion.hpp"

namespace dipper::dem {
namespace {

/// The number of meshes that a wall contact uses: the first of those it was made with. Protected in
/// LIGGGHTS, so accessible from a derived class.
struct Meshes : LAMMPS_NS::FixWallGran {
  static int& number(LAMMPS_NS::FixWallGran& wall) { return wall.*(&Meshes::n_FixMesh_); }
};

}  // namespace

ContactPause::ContactPause(LAMMPS_NS::LAMMPS& lmp, const setup::RockSetup& setup,
                           const std::vector<WallMotion*>& walls)
    : lmp_(lmp), floor_(setup.floor), walls_(walls) {
  contact_ = dynamic_cast<LAMMPS_NS::FixWallGran*>(lmp.modify->find_fix_id("walls"));
  if (contact_ == nullptr || !contact_->is_mesh_wall())
    throw std::runtime_error("the deck has no `fix walls all wall/gran ... mesh ...`");
  meshes_ = contact_->n_meshes();
  const int bodies = static_cast<int>(setup.bodies.size());
  for (int b = 0; b < bodies; ++b) {
    const int at = meshes_ - bodies + b;
    if (at < 0 || contact_->mesh_list()[at]->id != setup.bodies[static_cast<std::size_t>(b)])
      throw std::runtime_error("the deck's `fix walls` must name the bodies' meshes last");
  }
}

std::vector<core::Channel> ContactPause::channels() const {
  return {{"cleared_overlap", "kg", "-"}, {"cleared_floor", "kg", "-"}};
}

void ContactPause::measure(const std::vector<Pose>&, std::vector<double>& parts) const {
  const bool mine = lmp_.comm->me == 0;  // the record gets the sum over ranks
  parts.insert(parts.end(), {mine ? overlap_kg_ : 0, mine ? floor_kg_ : 0});
}

bool ContactPause::needs_all_rock(const RockWindow& window) const {
  return !touches_ && window.contact;
}

void ContactPause::before_window(const RockWindow& window) {
  if (window.contact == touches_) return;
  let_touch(window.contact);
  if (touches_) clear();
}

void ContactPause::let_touch(bool touch) {
  touches_ = touch;
  Meshes::number(*contact_) = touch ? meshes_ : meshes_ - static_cast<int>(walls_.size());
}

void ContactPause::clear() {
  std::vector<mesh::TriangleMesh> walls;
  for (const WallMotion* wall : walls_) walls.push_back(wall->in_world());
  lmp_.modify->setup_pre_exchange();  // contact history goes from the lists to the spheres
  const Cleared in_steel = remove_rock(lmp_, overlaps(walls));
  Cleared on_floor;
  if (floor_) {
    on_floor = remove_rock(lmp_, [&](const Vector3d& p, double) {
      return p.x() < floor_->to_x_m && std::abs(p.y()) < floor_->half_width_m &&
             p.z() < floor_->height_m;
    });
  }
  lmp_.update->integrate->setup_minimal(1);
  overlap_kg_ += in_steel.mass_kg;
  floor_kg_ += on_floor.mass_kg;
  if (lmp_.comm->me == 0)
    fmt::print(
        "the dipper is back: {:.0f} rocks, {:.0f} kg, inside its plates and {:.0f} rocks, {:.0f} "
        "kg, on the floor were removed\n",
        in_steel.rocks, in_steel.mass_kg, on_floor.rocks, on_floor.mass_kg);
}

void ContactPause::save(ByteWriter& out) const {
  out.put(touches_);
  out.put(overlap_kg_);
  out.put(floor_kg_);
}

void ContactPause::load(ByteReader& in) {
  let_touch(in.get<bool>());
  overlap_kg_ = in.get<double>();
  floor_kg_ = in.get<double>();
}

}  // namespace dipper::dem
