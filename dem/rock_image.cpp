#include "dem/rock_image.hpp"

#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <fix.h>
#include <fix_multisphere.h>
#include <fmt/format.h>
#include <integrate.h>
#include <lammps.h>
#include <modify.h>
#include <mpi.h>
#include <update.h>
#include <write_restart.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "dem/all_ranks.hpp"
#include "dem/deflated.hpp"
#include "dem/parked_rock.hpp"

namespace dipper::dem {
namespace {

using LAMMPS_NS::FixMultisphere;

/// Force and torque with which a sphere (by id) or a multisphere (by tag) continues.
struct Load {
  int id;
  std::array<double, 6> load;
};

Load load_of(int id, const double* force, const double* torque) {
  return {id, {force[0], force[1], force[2], torque[0], torque[1], torque[2]}};
}

/// Loads of all ranks, by id: building lists may send rock to another rank.
std::unordered_map<int, std::array<double, 6>> gathered(const std::vector<Load>& mine,
                                                        LAMMPS_NS::LAMMPS& lmp) {
  std::unordered_map<int, std::array<double, 6>> by_id;
  for (const Load& l : of_all_ranks(mine, lmp.world)) by_id[l.id] = l.load;
  return by_id;
}

void set(double* force, double* torque, const std::array<double, 6>& load) {
  std::copy_n(load.begin(), 3, force);
  std::copy_n(load.begin() + 3, 3, torque);
}

constexpr const char* kForce = "fcm";
constexpr const char* kTorque = "torque";

}  // namespace

void write_restart_untouched(LAMMPS_NS::LAMMPS& lmp, const std::filesystem::path& file) {
  std::string name = file.string();
  LAMMPS_NS::WriteRestart(&lmp).write(name.data());
}

void put_rock(LAMMPS_NS::LAMMPS& lmp, ByteWriter& out) {
  // Contact history goes from the lists to the spheres; the lists keep theirs. Other fixes would
  // change the simulation here.
  for (int k = 0; k < lmp.modify->nfix; ++k)
    if (std::strncmp(lmp.modify->fix[k]->style, "contacthistory", 14) == 0)
      lmp.modify->fix[k]->setup_pre_exchange();
  LAMMPS_NS::Atom* atom = lmp.atom;
  std::vector<double> buffer(
      static_cast<std::size_t>(lmp.comm->maxexchange_atom + lmp.comm->maxexchange_fix + 4096));
  std::vector<Load> spheres, bodies;
  out.put(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i) {
    const int n = atom->avec->pack_exchange(i, buffer.data());
    out.put_all(std::vector<double>(buffer.begin(), buffer.begin() + n));
    spheres.push_back(load_of(atom->tag[i], atom->f[i], atom->torque[i]));
  }
  std::vector<std::vector<double>> packed;
  if (FixMultisphere* fix = multisphere_of(lmp)) {
    LAMMPS_NS::Multisphere& data = fix->data();
    double** force = data.extract_double_vector(kForce);
    double** torque = data.extract_double_vector(kTorque);
    for (int b = 0; b < data.n_body(); ++b) {
      packed.push_back(packed_body(data, b));
      bodies.push_back(load_of(data.tag(b), force[b], torque[b]));
    }
  }
  out.put(packed.size());
  for (const auto& p : packed) out.put_all(p);
  out.put_all(spheres);
  out.put_all(bodies);
}

void get_rock(LAMMPS_NS::LAMMPS& lmp, ByteReader& in) {
  LAMMPS_NS::Atom* atom = lmp.atom;
  FixMultisphere* fix = multisphere_of(lmp);
  lmp.modify->setup_pre_exchange();
  atom->map_clear();
  atom->nlocal = atom->nghost = 0;  // ghosts too: their ids would be cleared again from the map
  const int spheres = in.get<int>();
  for (int i = 0; i < spheres; ++i) atom->avec->unpack_exchange(in.get_all<double>().data());
  while (fix != nullptr && fix->data().n_body() > 0) fix->data().remove_body(0);
  const auto bodies = in.get<std::size_t>();
  for (std::size_t b = 0; b < bodies; ++b) add_body(fix->data(), in.get_all<double>());
  const LAMMPS_NS::bigint mine = atom->nlocal;
  MPI_Allreduce(&mine, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lmp.world);
  renew_maps(lmp);
  lmp.update->integrate->setup_minimal(1);

  const auto sphere_loads = gathered(in.get_all<Load>(), lmp);
  const auto body_loads = gathered(in.get_all<Load>(), lmp);
  for (int i = 0; i < atom->nlocal; ++i)
    set(atom->f[i], atom->torque[i], sphere_loads.at(atom->tag[i]));
  if (fix == nullptr) return;
  LAMMPS_NS::Multisphere& data = fix->data();
  double** force = data.extract_double_vector(kForce);
  double** torque = data.extract_double_vector(kTorque);
  for (int b = 0; b < data.n_body(); ++b) set(force[b], torque[b], body_loads.at(data.tag(b)));
}

void write_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp,
                 const std::function<void(ByteWriter&)>& put) {
  ByteWriter mine;
  put(mine);
  if (mine.bytes().size() > std::numeric_limits<int>::max())
    throw std::runtime_error(
        fmt::format("{}: a rank's part of it is {} bytes, and MPI sends 2^31; use more ranks",
                    file.string(), mine.bytes().size()));
  const int ranks = lmp.comm->nprocs;
  const Deflated packed = deflated(mine.bytes(), 1);
  ByteWriter part;
  part.put(packed.length);
  part.put(packed.crc);
  const std::string bytes = part.bytes() + packed.bytes;
  const auto size = static_cast<int>(bytes.size());
  std::vector<int> sizes(static_cast<std::size_t>(ranks));
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, lmp.world);
  if (lmp.comm->me != 0) {
    MPI_Send(bytes.data(), size, MPI_BYTE, 0, 0, lmp.world);
    return;
  }
  // One after the other: all of them together may exceed rank 0's memory.
  ByteWriter head;
  head.put_all(sizes);
  std::ofstream out(file, std::ios::binary);
  out << head.bytes() << bytes;
  for (int r = 1; r < ranks; ++r) {
    std::string theirs(static_cast<std::size_t>(sizes[static_cast<std::size_t>(r)]), '\0');
    MPI_Recv(theirs.data(), static_cast<int>(theirs.size()), MPI_BYTE, r, 0, lmp.world,
             MPI_STATUS_IGNORE);
    out << theirs;
  }
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

ByteReader read_image(const std::filesystem::path& file, LAMMPS_NS::LAMMPS& lmp) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  const auto read = [&](void* to, std::size_t size) {
    in.read(static_cast<char*>(to), static_cast<std::streamsize>(size));
    if (!in) throw std::runtime_error(file.string() + ": it is incomplete");
  };
  const auto ranks = static_cast<std::size_t>(lmp.comm->nprocs);
  std::size_t written = 0;
  read(&written, sizeof written);
  if (written != ranks)
    throw std::runtime_error(fmt::format("{}: written by {} ranks; {} cannot continue from it",
                                         file.string(), written, ranks));
  std::vector<int> sizes(ranks);
  read(sizes.data(), ranks * sizeof(int));
  const auto mine = sizes.begin() + lmp.comm->me;
  in.seekg(std::accumulate(sizes.begin(), mine, std::streamoff{0}), std::ios::cur);
  Deflated part;
  constexpr std::size_t kHead = sizeof part.length + sizeof part.crc;
  read(&part.length, sizeof part.length);
  read(&part.crc, sizeof part.crc);
  part.bytes.resize(std::max(static_cast<std::size_t>(*mine), kHead) - kHead);
  read(part.bytes.data(), part.bytes.size());
  if (part.length > std::numeric_limits<int>::max())
    throw std::runtime_error(file.string() + ": it is damaged, or of another version of Dipper");
  try {
    return ByteReader(inflated(part));
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(file.string() + ": " + e.what());
  }
}

}  // namespace dipper::dem
