// LIGGGHTS's own per-contact output, `compute wall/gran/local`, at the instant the force acted.
#pragma once

#include <compute.h>
#include <fix.h>
#include <lammps.h>
#include <modify.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace dipper::test {

/// One row of `compute ... wall/gran/local pos id force torque`. LIGGGHTS documents `contactPoint`
/// for the point, but fills it for pairs of spheres only; of a wall's rows, `pos` holds it.
struct Contact {
  int mesh;         ///< place in `wall/gran ... meshes`
  Vector3d point;   ///< where the force acts [m]
  Vector3d centre;  ///< of the sphere [m]
  Vector3d force;   ///< of the wall on the sphere [N]
  Vector3d torque;  ///< about the sphere's centre, rolling friction included [N m]
};

/// Lists this rank's contacts in each step, after the walls' forces and before the velocities'
/// second half step. The compute evaluates the contact law again: at a step's end, when LIGGGHTS
/// writes its output, velocities have moved on and the damping would not be the one that acted.
class ContactList : public LAMMPS_NS::Fix {
 public:
  /// Before the first step; LIGGGHTS owns it. `compute_id` has the columns of Contact.
  static ContactList* attach(LAMMPS_NS::LAMMPS& lmp, const std::string& compute_id) {
    // As WallMotion::attach does: a fix that does nothing, then ours in its place.
    std::vector<std::string> words = {"contact_list", "all", "print", "2000000000", "-"};
    std::vector<char*> args;
    for (auto& w : words) args.push_back(w.data());
    lmp.modify->add_fix(5, args.data());
    const int slot = lmp.modify->find_fix("contact_list");
    auto* list = new ContactList(lmp, args, compute_id);
    delete lmp.modify->fix[slot];
    lmp.modify->fix[slot] = list;
    lmp.modify->fmask[slot] = list->setmask();
    return list;
  }

  int setmask() override { return LAMMPS_NS::FixConst::POST_FORCE; }

  void post_force(int) override {
    compute_->compute_local();
    auto& contacts = steps.emplace_back();
    for (int i = 0; i < compute_->size_local_rows; ++i) {
      const double* r = compute_->array_local[i];
      const auto at = [&](int k) { return Vector3d(r[k], r[k + 1], r[k + 2]); };
      contacts.push_back({static_cast<int>(r[6]), at(0), at(3), at(9), at(12)});
    }
  }

  std::vector<std::vector<Contact>> steps;  ///< this rank's, a step an entry; whoever reads clears

 private:
  ContactList(LAMMPS_NS::LAMMPS& l, std::vector<char*>& args, const std::string& compute_id)
      : Fix(&l, 5, args.data()), compute_(modify->find_compute_id(compute_id.c_str())) {
    if (compute_ == nullptr || compute_->size_local_cols != 15) {
      throw std::runtime_error("the deck has no such compute wall/gran/local pos id force torque");
    }
  }

  LAMMPS_NS::Compute* compute_;
};

}  // namespace dipper::test
