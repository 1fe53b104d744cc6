#include "dem/fast/border_exchange.hpp"

#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <fix_multisphere.h>
#include <lammps.h>
#include <mpi.h>

#include <algorithm>
#include <utility>

#include "dem/rest_group.hpp"

namespace dipper::dem {
namespace {

/// Protected members of LIGGGHTS. For each swap of borders: the ranks it goes to and comes from,
/// the spheres sent, and the index of the first one received.
struct OpenComm : LAMMPS_NS::Comm {
  static constexpr auto swaps = &OpenComm::nswap;
  static constexpr auto to = &OpenComm::sendproc;
  static constexpr auto from = &OpenComm::recvproc;
  static constexpr auto sent = &OpenComm::sendnum;
  static constexpr auto received = &OpenComm::recvnum;
  static constexpr auto list = &OpenComm::sendlist;
  static constexpr auto first = &OpenComm::firstrecv;
};

constexpr int kPlaceAndVelocities = 9;  // numbers a sphere that LIGGGHTS passes on

/// Hands `mine` to rank `to` and returns what rank `from` hands over.
std::vector<int> swapped(const std::vector<int>& mine, int to, int from, MPI_Comm world) {
  const auto size = static_cast<int>(mine.size());
  int theirs = 0;
  MPI_Sendrecv(&size, 1, MPI_INT, to, 0, &theirs, 1, MPI_INT, from, 0, world, MPI_STATUS_IGNORE);
  std::vector<int> all(static_cast<std::size_t>(theirs));
  MPI_Sendrecv(mine.data(), size, MPI_INT, to, 0, all.data(), theirs, MPI_INT, from, 0, world,
               MPI_STATUS_IGNORE);
  return all;
}

}  // namespace

bool BorderExchange::renew(LAMMPS_NS::FixMultisphere& bodies) {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  const LAMMPS_NS::Comm& comm = *lmp_.comm;
  swaps_.clear();
  const LAMMPS_NS::AtomVec& kind = *atom.avec;
  if (comm.*OpenComm::swaps != 2 || comm.ghost_velocity == 0 ||
      kind.size_forward + kind.size_velocity != kPlaceAndVelocities)
    return false;
  const int resting = rest_bit(lmp_);
  for (int s = 0; s < 2; ++s) {
    Swap swap{(comm.*OpenComm::to)[s], (comm.*OpenComm::from)[s], {}, {}, {}, {}};
    const int* list = (comm.*OpenComm::list)[s];
    const int first = (comm.*OpenComm::first)[s];
    // Places in the swap's list: of those that move their rank knows, of bodies the bodies' rank.
    std::vector<int> moving, of_body;
    for (int k = 0; k < (comm.*OpenComm::sent)[s]; ++k)
      if ((atom.mask[list[k]] & resting) == 0) moving.push_back(k);
    for (int k = 0; k < (comm.*OpenComm::received)[s]; ++k) {
      const int tag = bodies.belongs_to(first + k);
      if (tag >= 0 && bodies.data().map(tag) >= 0) of_body.push_back(k);
    }
    swap.moving_in = swapped(moving, swap.to, swap.from, lmp_.world);
    swap.of_body_out = swapped(of_body, swap.from, swap.to, lmp_.world);
    for (int& k : moving) k = list[k];
    for (int& k : swap.of_body_out) k = list[k];
    for (int& k : swap.moving_in) k += first;
    for (int& k : of_body) k += first;
    swap.moving_out = std::move(moving);
    swap.of_body_in = std::move(of_body);
    swaps_.push_back(std::move(swap));
  }
  sent_.resize(swaps_.size());
  received_.resize(swaps_.size());
  return true;
}

void BorderExchange::return_moved_spheres() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  pass(Way::home, &Swap::of_body_in, &Swap::of_body_out, {atom.x, atom.v, atom.omega});
}

void BorderExchange::return_velocities() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  pass(Way::home, &Swap::of_body_in, &Swap::of_body_out, {atom.v, atom.omega});
}

void BorderExchange::forward_moved_spheres() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  pass(Way::forward, &Swap::moving_out, &Swap::moving_in, {atom.x, atom.v, atom.omega});
}

void BorderExchange::forward_forces() {
  const LAMMPS_NS::Atom& atom = *lmp_.atom;
  pass(Way::forward, &Swap::of_body_out, &Swap::of_body_in, {atom.f, atom.torque});
}

void BorderExchange::pass(Way way, std::vector<int> Swap::*out, std::vector<int> Swap::*in,
                          std::initializer_list<double**> vectors) {
  std::vector<MPI_Request> requests;
  requests.reserve(2 * swaps_.size());
  const std::size_t width = 3 * vectors.size();
  for (std::size_t s = 0; s < swaps_.size(); ++s) {
    received_[s].resize(width * (swaps_[s].*in).size());
    if (received_[s].empty()) continue;
    const int from = way == Way::forward ? swaps_[s].from : swaps_[s].to;
    MPI_Irecv(received_[s].data(), static_cast<int>(received_[s].size()), MPI_DOUBLE, from,
              static_cast<int>(s), lmp_.world, &requests.emplace_back());
  }
  for (std::size_t s = 0; s < swaps_.size(); ++s) {
    sent_[s].resize(width * (swaps_[s].*out).size());
    if (sent_[s].empty()) continue;
    double* to = sent_[s].data();
    for (const int i : swaps_[s].*out)
      for (double* const* v : vectors) to = std::copy_n(v[i], 3, to);
    MPI_Isend(sent_[s].data(), static_cast<int>(sent_[s].size()), MPI_DOUBLE,
              way == Way::forward ? swaps_[s].to : swaps_[s].from, static_cast<int>(s), lmp_.world,
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t s = 0; s < swaps_.size(); ++s) {
    const double* from = received_[s].data();
    for (const int i : swaps_[s].*in)
      for (double** v : vectors) {
        std::copy_n(from, 3, v[i]);
        from += 3;
      }
  }
}

}  // namespace dipper::dem
