#include "dem/fast/near_lists.hpp"

#include <atom.h>
#include <error.h>
#include <fix_contact_history.h>
#include <mpi.h>
#include <neigh_list.h>
#include <neigh_request.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dipper::dem {

void NearLists::choose_build(int list, LAMMPS_NS::NeighRequest* request) {
  Neighbor::choose_build(list, request);
  const bool known = request->gran == 1 && request->omp == 0 && request->copy == 0 &&
                     request->skip == 0 && request->ghost == 0 && style == 1 && newton_pair == 0 &&
                     includegroup == 0;
  if (known) pair_build[list] = static_cast<PairPtr>(&NearLists::build_near);
}

void NearLists::build(int topology) {
  Neighbor::build(topology);
  moved_ = 0;
  known_ = false;
}

int NearLists::check_distance() {
  // LIGGGHTS checks every sphere in every step. No sphere can have moved half the skin before the
  // fastest could have.
  if (boxcheck != 0) return Neighbor::check_distance();
  int far = 0;
  if (!known_ || moved_ > 0.5 * skin) {
    moved_ = farthest();
    far = moved_ > 0.5 * skin ? 1 : 0;
  }
  known_ = false;
  int any = 0;
  MPI_Allreduce(&far, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

double NearLists::farthest() const {
  double most = 0;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *x = atom->x[i], *was = xhold[i];
    const double d[3] = {x[0] - was[0], x[1] - was[1], x[2] - was[2]};
    most = std::max(most, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  return std::sqrt(most);
}

int NearLists::Level::bin(int axis, double x) const {
  return std::clamp(static_cast<int>((x - lo[axis]) * per_m), 0, n[axis] - 1);
}

void NearLists::fill_levels() {
  const int all = atom->nlocal + atom->nghost;
  double smallest = kFar, largest = 0;
  for (int i = 0; i < all; ++i) {
    smallest = std::min(smallest, atom->radius[i]);
    largest = std::max(largest, atom->radius[i]);
  }
  levels_.clear();
  for (double r = smallest; all > 0; r *= kStep) {
    levels_.emplace_back();
    if (r * kStep > largest) break;
  }
  std::vector<int> level(static_cast<std::size_t>(all));
  std::vector<std::vector<int>> of(levels_.size());
  for (int i = 0; i < all; ++i) {
    const auto l = static_cast<std::size_t>(std::log(atom->radius[i] / smallest) / std::log(kStep));
    of[std::min(l, of.size() - 1)].push_back(i);
  }
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    Level& to = levels_[l];
    double hi[3] = {-kFar, -kFar, -kFar};
    std::fill_n(to.lo, 3, kFar);
    for (const int i : of[l]) {
      to.largest_m = std::max(to.largest_m, atom->radius[i]);
      for (int k = 0; k < 3; ++k) {
        to.lo[k] = std::min(to.lo[k], atom->x[i][k]);
        hi[k] = std::max(hi[k], atom->x[i][k]);
      }
    }
    if (of[l].empty()) continue;
    double wide = 2 * to.largest_m * contactDistanceFactor + skin;
    const double most = 4.0 * all + 1000;  // bins: a rock far away must not need many
    for (double count = kFar; count > most; wide *= 1.25) {
      count = 1;
      to.per_m = 1 / wide;
      for (int k = 0; k < 3; ++k) {
        const double n = std::floor((hi[k] - to.lo[k]) * to.per_m) + 1;
        count *= n;
        to.n[k] = static_cast<int>(std::min(n, most));
      }
    }
    to.first.assign(static_cast<std::size_t>(to.n[0]) * to.n[1] * to.n[2] + 1, 0);
    std::vector<int> bin_of(of[l].size());
    for (std::size_t s = 0; s < of[l].size(); ++s) {
      const double* x = atom->x[of[l][s]];
      bin_of[s] = (to.bin(2, x[2]) * to.n[1] + to.bin(1, x[1])) * to.n[0] + to.bin(0, x[0]);
      ++to.first[static_cast<std::size_t>(bin_of[s]) + 1];
    }
    for (std::size_t b = 1; b < to.first.size(); ++b) to.first[b] += to.first[b - 1];
    to.spheres.resize(of[l].size());
    std::vector<int> next(to.first.begin(), to.first.end() - 1);
    for (std::size_t s = 0; s < of[l].size(); ++s) {
      const int i = of[l][s];
      const double* x = atom->x[i];
      to.spheres[next[bin_of[s]]++] = {x[0], x[1], x[2], atom->radius[i], i};
    }
  }
}

void NearLists::find_pairs() {
  const int local = atom->nlocal;
  pairs_.clear();
  first_pair_.assign(static_cast<std::size_t>(local) + 1, 0);
  const auto look = [&](const Near& a, const Near* b, const Near* end) {
    for (; b < end; ++b) {
      const double dx = a.x - b->x, dy = a.y - b->y, dz = a.z - b->z;
      const double cut = (a.radius + b->radius) * contactDistanceFactor + skin;
      if (dx * dx + dy * dy + dz * dz > cut * cut) continue;
      const auto [i, j] = std::minmax(a.index, b->index);
      if (i >= local) continue;
      if (exclude && exclusion(i, j, atom->type[i], atom->type[j], atom->mask, atom->molecule))
        continue;
      pairs_.emplace_back(i, j);
      ++first_pair_[static_cast<std::size_t>(i) + 1];
    }
  };
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    for (const Near& a : levels_[l].spheres) {
      const double x[3] = {a.x, a.y, a.z};
      for (std::size_t m = l; m < levels_.size(); ++m) {
        const Level& level = levels_[m];
        if (level.spheres.empty()) continue;
        const double reach = (a.radius + level.largest_m) * contactDistanceFactor + skin;
        int lo[3], hi[3];
        for (int k = 0; k < 3; ++k) {
          lo[k] = level.bin(k, x[k] - reach);
          hi[k] = level.bin(k, x[k] + reach);
        }
        const auto row_of = [&](int y, int z) { return (z * level.n[1] + y) * level.n[0]; };
        // In its own level it takes only bins behind it; the others find it from theirs.
        const int own = m == l ? row_of(level.bin(1, a.y), level.bin(2, a.z)) : -1;
        for (int z = lo[2]; z <= hi[2]; ++z) {
          for (int y = lo[1]; y <= hi[1]; ++y) {
            const int row = row_of(y, z);
            if (row < own) continue;
            const Near* const all = level.spheres.data();
            look(a, row == own ? &a + 1 : all + level.first[row + lo[0]],
                 all + level.first[row + hi[0] + 1]);
          }
        }
      }
    }
  }
  for (std::size_t i = 1; i < first_pair_.size(); ++i) first_pair_[i] += first_pair_[i - 1];
  near_.resize(pairs_.size());
  std::vector<std::size_t> next(first_pair_.begin(), first_pair_.end() - 1);
  for (const auto& [i, j] : pairs_) near_[next[static_cast<std::size_t>(i)]++] = j;
}

void NearLists::build_near(LAMMPS_NS::NeighList* list) {
  bin_atoms();  // the lists of the walls use these
  fill_levels();
  find_pairs();
  LAMMPS_NS::FixContactHistory* history = list->fix_history;
  LAMMPS_NS::NeighList* contacts = list->listgranhistory;
  const int width = history != nullptr ? contacts->dnum : 0;
  list->ipage->reset();
  if (history != nullptr) {
    contacts->ipage->reset();
    contacts->dpage->reset();
  }
  for (int i = 0; i < atom->nlocal; ++i) {
    const double *x = atom->x[i], r = atom->radius[i];
    const auto row = static_cast<std::size_t>(i);
    const auto count = static_cast<int>(first_pair_[row + 1] - first_pair_[row]);
    if (count >= oneatom) error->one(FLERR, "Neighbor list overflow, boost neigh_modify one");
    int* const near = list->ipage->get(count);
    std::copy_n(near_.data() + first_pair_[row], count, near);
    std::sort(near, near + count);
    list->ilist[i] = i;
    list->firstneigh[i] = near;
    list->numneigh[i] = count;
    if (history == nullptr) continue;
    int* const touches = contacts->ipage->get(count);
    double* const values = contacts->dpage->get(width * count);
    std::fill_n(touches, count, 0);
    std::fill_n(values, width * count, 0.0);
    contacts->firstneigh[i] = touches;
    contacts->firstdouble[i] = values;
    for (int m = 0; m < history->n_partner(i); ++m) {
      const int tag = history->partner(i, m);
      for (int n = 0; n < count; ++n) {
        const int j = near[n];
        if (atom->tag[j] != tag) continue;
        const double* y = atom->x[j];
        const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
        const double touch = (r + atom->radius[j]) * contactDistanceFactor;
        if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] >= touch * touch) break;
        touches[n] = 1;
        std::copy_n(history->contacthistory(i, m), width, values + width * n);
        break;
      }
    }
  }
  list->inum = atom->nlocal;
}

}  // namespace dipper::dem
