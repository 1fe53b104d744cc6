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

#include "dem/rock_dump.hpp"

namespace dipper::dem {

using LAMMPS_NS::Atom;
using LAMMPS_NS::FixContactHistory;
using LAMMPS_NS::FixMultisphere;
using LAMMPS_NS::Multisphere;

namespace {

constexpr int kOperation = LAMMPS_NS::OPERATION_COMM_EXCHANGE;

/// LIGGGHTS keeps the bodies on a rank in arrays that grow automatically, and their number
/// separately.
int& number_of_bodies(Multisphere& bodies) {
  int len1, len2;
  return *static_cast<int*>(bodies.extract("nbody", len1, len2));
}

}  // namespace

FixMultisphere* multisphere_of(LAMMPS_NS::LAMMPS& lmp) {
  return static_cast<FixMultisphere*>(lmp.modify->find_fix_style("multisphere", 0));
}

std::vector<double> packed_body(Multisphere& bodies, int body) {
  const int size = bodies.prop().elemBufSize(kOperation, nullptr, false, false, false);
  std::vector<double> packed(static_cast<std::size_t>(size));
  const int n =
      bodies.prop().pushElemToBuffer(body, packed.data(), kOperation, false, false, false);
  packed.resize(static_cast<std::size_t>(n));
  return packed;
}

void add_body(Multisphere& bodies, std::vector<double> packed) {
  bodies.prop().popElemFromBuffer(packed.data(), kOperation, false, false, false);
  ++number_of_bodies(bodies);
}

void renew_maps(LAMMPS_NS::LAMMPS& lmp) {
  lmp.atom->map_init();
  if (FixMultisphere* fix = multisphere_of(lmp)) {
    fix->data().calc_nbody_all();
    fix->data().generate_map();
  }
}

RockNumbers::RockNumbers(ByteReader& in)
    : spheres_(in.get<std::size_t>()),
      size_(in.get<std::size_t>()),
      rock_(in.get_all<std::size_t>()) {}

void RockNumbers::save(ByteWriter& out) const {
  out.put(spheres_);
  out.put(size_);
  out.put_all(rock_);
}

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

ParkedRock::ParkedRock(LAMMPS_NS::LAMMPS& lmp, const RockNumbers& numbers, RockDump* dump)
    : lmp_(lmp), numbers_(numbers), dump_(dump), bodies_(multisphere_of(lmp)), history_(nullptr) {
  for (int k = 0; k < lmp.modify->nfix; ++k)
    if (std::strcmp(lmp.modify->fix[k]->style, "contacthistory") == 0)
      history_ = static_cast<FixContactHistory*>(lmp.modify->fix[k]);
  if (history_ == nullptr)
    throw std::runtime_error(
        "rock at rest can be held only with a contact model that has history (tangential history)");
  if (dump_ != nullptr) dump_->show(this);
}

ParkedRock::~ParkedRock() {
  if (dump_ != nullptr) dump_->show(nullptr);
}

void ParkedRock::change(const std::vector<Rest>& rest) {
  lmp_.atom->map_clear();  // while every sphere in it still exists
  lmp_.atom->nghost = 0;   // later code would look for the ghosts' ids behind the spheres
  take_out(rest);
  put_back(rest);
  keep_history(rest);
  renew_maps(lmp_);
}

void ParkedRock::take_out(const std::vector<Rest>& rest) {
  Atom* atom = lmp_.atom;
  std::vector<int> leaving;
  for (int i = 0; i < atom->nlocal; ++i)
    if (rest[numbers_.of_sphere(atom->tag[i])] == Rest::parked) leaving.push_back(i);
  const std::vector<double> rows = dump_ == nullptr ? std::vector<double>{} : dump_->rows(leaving);
  const std::size_t width = dump_ == nullptr ? 0 : dump_->width();
  const int most = lmp_.comm->maxexchange_atom + lmp_.comm->maxexchange_fix + 4096;
  std::vector<double> buffer(static_cast<std::size_t>(most));
  auto row = rows.begin();
  for (const int i : leaving) {
    const std::size_t rock = numbers_.of_sphere(atom->tag[i]);
    const Vector3d p_W = Eigen::Map<const Vector3d>(atom->x[i]);
    const int n = atom->avec->pack_exchange(i, buffer.data());
    const auto end = row + static_cast<std::ptrdiff_t>(width);
    spheres_.push_back(
        {rock, p_W, atom->radius[i], {buffer.begin(), buffer.begin() + n}, {row, end}});
    row = end;
    if (rock == static_cast<std::size_t>(atom->tag[i]))
      masses_.push_back({rock, p_W, atom->rmass[i], {}});
  }
  // From the last one, so that the sphere that takes a removed one's place stays.
  for (auto i = leaving.rbegin(); i != leaving.rend(); ++i) {
    atom->avec->copy(atom->nlocal - 1, *i, 1);
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
    masses_.push_back({rock, p_W, data.mass(b), packed_body(data, b)});
    data.remove_body(b);
  }
}

void ParkedRock::put_back(const std::vector<Rest>& rest) {
  const auto returns = [&](const auto& entry) { return rest[entry.rock] != Rest::parked; };
  for (Sphere& s : spheres_)
    if (returns(s)) lmp_.atom->avec->unpack_exchange(s.packed.data());
  for (const Mass& m : masses_) {
    if (!returns(m) || m.packed.empty()) continue;
    add_body(bodies_->data(), m.packed);
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

void ParkedRock::save(ByteWriter& out) const {
  out.put(spheres_.size());
  for (const Sphere& s : spheres_) {
    out.put(s.rock);
    for (int k = 0; k < 3; ++k) out.put(s.p_W[k]);
    out.put(s.radius_m);
    out.put_all(s.packed);
    out.put_all(s.shown);
  }
  out.put(masses_.size());
  for (const Mass& m : masses_) {
    out.put(m.rock);
    for (int k = 0; k < 3; ++k) out.put(m.p_W[k]);
    out.put(m.mass_kg);
    out.put_all(m.packed);
  }
  out.put(kept_.size());
  for (const auto& [id, history] : kept_) {
    out.put(id);
    out.put(history.size());
    for (const auto& [partner, values] : history) {
      out.put(partner);
      out.put_all(values);
    }
  }
}

void ParkedRock::load(ByteReader& in) {
  const auto vector = [&] {
    Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = in.get<double>();
    return v;
  };
  spheres_.resize(in.get<std::size_t>());
  for (Sphere& s : spheres_) {
    s.rock = in.get<std::size_t>();
    s.p_W = vector();
    s.radius_m = in.get<double>();
    s.packed = in.get_all<double>();
    s.shown = in.get_all<double>();
    if (s.shown.size() != (dump_ == nullptr ? 0 : dump_->width()))
      throw std::runtime_error(
          "it was written by another version, or with other columns in the deck's dump");
  }
  masses_.resize(in.get<std::size_t>());
  for (Mass& m : masses_) {
    m.rock = in.get<std::size_t>();
    m.p_W = vector();
    m.mass_kg = in.get<double>();
    m.packed = in.get_all<double>();
  }
  kept_.clear();
  for (auto n = in.get<std::size_t>(); n > 0; --n) {
    const int id = in.get<int>();
    History& history = kept_[id];
    for (auto contacts = in.get<std::size_t>(); contacts > 0; --contacts) {
      const int partner = in.get<int>();
      history.emplace_back(partner, in.get_all<double>());
    }
  }
}

}  // namespace dipper::dem
