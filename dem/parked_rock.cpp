#include "dem/parked_rock.hpp"

#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <fix_contact_history.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <modify.h>
#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace dipper::dem {

using LAMMPS_NS::Atom;
using LAMMPS_NS::FixContactHistory;
using LAMMPS_NS::FixMultisphere;
using LAMMPS_NS::Multisphere;

namespace {

constexpr int kOperation = LAMMPS_NS::OPERATION_COMM_EXCHANGE;

FixMultisphere* multisphere_of(LAMMPS_NS::LAMMPS& lmp) {
  return static_cast<FixMultisphere*>(lmp.modify->find_fix_style("multisphere", 0));
}

/// LIGGGHTS keeps the bodies on a rank in arrays that grow by themselves, and their number apart.
int& number_of_bodies(Multisphere& bodies) {
  int len1, len2;
  return *static_cast<int*>(bodies.extract("nbody", len1, len2));
}

}  // namespace

RockNumbers::RockNumbers(LAMMPS_NS::LAMMPS& lmp) {
  const Atom* atom = lmp.atom;
  FixMultisphere* bodies = multisphere_of(lmp);
  spheres_ = static_cast<std::size_t>(lmp.atom->tag_max()) + 1;
  size_ = spheres_ + (bodies == nullptr ? 0 : static_cast<std::size_t>(bodies->tag_max_body()) + 1);
  std::vector<int> body(spheres_, -1);
  for (int i = 0; bodies != nullptr && i < atom->nlocal; ++i)
    body[static_cast<std::size_t>(atom->tag[i])] = bodies->belongs_to(i);
  MPI_Allreduce(MPI_IN_PLACE, body.data(), static_cast<int>(spheres_), MPI_INT, MPI_MAX, lmp.world);
  rock_.resize(spheres_);
  for (std::size_t tag = 0; tag < spheres_; ++tag)
    rock_[tag] = body[tag] < 0 ? tag : of_body(body[tag]);
}

ParkedRock::ParkedRock(LAMMPS_NS::LAMMPS& lmp, const RockNumbers& numbers)
    : lmp_(lmp), numbers_(numbers), bodies_(multisphere_of(lmp)), history_(nullptr) {
  for (int k = 0; k < lmp.modify->nfix; ++k)
    if (std::strcmp(lmp.modify->fix[k]->style, "contacthistory") == 0)
      history_ = static_cast<FixContactHistory*>(lmp.modify->fix[k]);
  if (history_ == nullptr)
    throw std::runtime_error(
        "rock at rest can be held only with a contact model that has history (tangential history)");
}

void ParkedRock::change(const std::vector<Rest>& rest) {
  lmp_.atom->map_clear();  // while every sphere that is in it is still here
  take_out(rest);
  put_back(rest);
  keep_history(rest);
}

void ParkedRock::take_out(const std::vector<Rest>& rest) {
  Atom* atom = lmp_.atom;
  const int most = lmp_.comm->maxexchange_atom + lmp_.comm->maxexchange_fix + 4096;
  std::vector<double> buffer(static_cast<std::size_t>(most));
  const auto packed = [&](int n) {
    return std::vector<double>(buffer.begin(), buffer.begin() + n);
  };
  for (int i = 0; i < atom->nlocal;) {
    const std::size_t rock = numbers_.of_sphere(atom->tag[i]);
    if (rest[rock] != Rest::parked) {
      ++i;
      continue;
    }
    const Vector3d p_W = Eigen::Map<const Vector3d>(atom->x[i]);
    const int n = atom->avec->pack_exchange(i, buffer.data());
    spheres_.push_back({rock, p_W, atom->radius[i], packed(n)});
    if (rock == static_cast<std::size_t>(atom->tag[i]))
      masses_.push_back({rock, p_W, atom->rmass[i], {}});
    atom->avec->copy(atom->nlocal - 1, i, 1);
    --atom->nlocal;
  }
  if (bodies_ == nullptr) return;
  Multisphere& data = bodies_->data();
  for (int b = 0; b < data.n_body();) {
    const std::size_t rock = numbers_.of_body(data.tag(b));
    if (rest[rock] != Rest::parked) {
      ++b;
      continue;
    }
    Vector3d p_W;
    data.xcm(p_W.data(), b);
    const auto size =
        static_cast<std::size_t>(data.prop().elemBufSize(kOperation, nullptr, false, false, false));
    if (buffer.size() < size) buffer.resize(size);
    const int n = data.prop().pushElemToBuffer(b, buffer.data(), kOperation, false, false, false);
    masses_.push_back({rock, p_W, data.mass(b), packed(n)});
    data.remove_body(b);
  }
}

void ParkedRock::put_back(const std::vector<Rest>& rest) {
  const auto returns = [&](const auto& entry) { return rest[entry.rock] != Rest::parked; };
  for (Sphere& s : spheres_)
    if (returns(s)) lmp_.atom->avec->unpack_exchange(s.packed.data());
  for (Mass& m : masses_) {
    if (!returns(m) || m.packed.empty()) continue;
    bodies_->data().prop().popElemFromBuffer(m.packed.data(), kOperation, false, false, false);
    ++number_of_bodies(bodies_->data());
  }
  spheres_.erase(std::remove_if(spheres_.begin(), spheres_.end(), returns), spheres_.end());
  masses_.erase(std::remove_if(masses_.begin(), masses_.end(), returns), masses_.end());
}

void ParkedRock::keep_history(const std::vector<Rest>& rest) {
  const Atom* atom = lmp_.atom;
  const auto width = static_cast<std::size_t>(history_->get_dnum());
  const auto there = [&](int tag) { return rest[numbers_.of_sphere(tag)] != Rest::parked; };
  union {
    double d;
    std::int64_t i;
  } word;  // as LIGGGHTS packs its integers
  for (int i = 0; i < atom->nlocal; ++i) {
    const int tag = atom->tag[i];
    const auto before = kept_.find(tag);
    History all, absent;
    bool changed = false;
    for (int k = 0; k < history_->n_partner(i); ++k) {
      const double* h = history_->contacthistory(i, k);
      const int partner = history_->partner(i, k);
      auto& to = there(partner) ? all : absent;
      to.emplace_back(partner, std::vector<double>(h, h + width));
      changed = changed || !there(partner);
    }
    if (before != kept_.end()) {
      for (auto& entry : before->second) {
        auto& to = there(entry.first) ? all : absent;
        changed = changed || there(entry.first);
        to.push_back(std::move(entry));
      }
      kept_.erase(before);
    }
    if (!absent.empty()) kept_[tag] = std::move(absent);
    if (!changed) continue;
    std::vector<double> packed;
    word.i = static_cast<std::int64_t>(all.size());
    packed.push_back(word.d);
    for (const auto& [partner, h] : all) {
      word.i = partner;
      packed.push_back(word.d);
      packed.insert(packed.end(), h.begin(), h.end());
    }
    history_->unpack_exchange(i, packed.data());
  }
}

}  // namespace dipper::dem
