#include "dem/moist/crust.hpp"

#include <atom.h>
#include <fix_property_atom.h>
#include <force.h>
#include <modify.h>
#include <mpi.h>
#include <neigh_list.h>
#include <pair_gran.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "dem/moist/register_moist.hpp"

namespace dipper::dem {
namespace {

/// Highest rock over each cell of a grid in x and y; cells are a few spheres wide, so that a gap
/// between two rocks does not count as a hole in the surface.
class Surface {
 public:
  Surface(const LAMMPS_NS::Atom& atom, MPI_Comm comm) {
    double bounds[5];  // max radius, max x, max y, max -x, max -y
    std::fill_n(bounds, 5, -std::numeric_limits<double>::infinity());
    for (int i = 0; i < atom.nlocal; ++i) {
      const double* x = atom.x[i];
      const double of_sphere[5] = {atom.radius[i], x[0], x[1], -x[0], -x[1]};
      for (int k = 0; k < 5; ++k) bounds[k] = std::max(bounds[k], of_sphere[k]);
    }
    MPI_Allreduce(MPI_IN_PLACE, bounds, 5, MPI_DOUBLE, MPI_MAX, comm);
    cell_ = 4 * bounds[0];
    x_ = -bounds[3];
    y_ = -bounds[4];
    nx_ = 1 + static_cast<int>((bounds[1] - x_) / cell_);
    top_.assign(static_cast<std::size_t>(nx_) * (1 + static_cast<int>((bounds[2] - y_) / cell_)),
                -std::numeric_limits<double>::infinity());
    for (int i = 0; i < atom.nlocal; ++i) {
      double& top = top_[index(atom.x[i])];
      top = std::max(top, atom.x[i][2] + atom.radius[i]);
    }
    MPI_Allreduce(MPI_IN_PLACE, top_.data(), static_cast<int>(top_.size()), MPI_DOUBLE, MPI_MAX,
                  comm);
  }

  double above(const double* x) const { return top_[index(x)]; }

 private:
  std::size_t index(const double* x) const {
    return static_cast<std::size_t>((x[0] - x_) / cell_) +
           static_cast<std::size_t>(nx_) * static_cast<std::size_t>((x[1] - y_) / cell_);
  }

  double x_, y_, cell_;
  int nx_;
  std::vector<double> top_;
};

}  // namespace

void form_crust(LAMMPS_NS::LAMMPS& lmp, const setup::CrustZone& zone) {
  auto* mark = static_cast<LAMMPS_NS::FixPropertyAtom*>(lmp.modify->find_fix_property(
      "crust_zone", "property/atom", "scalar", 0, 0, "a crust", false));
  if (mark == nullptr) {
    throw std::runtime_error("the deck has no `fix crust_zone all property/atom crust_zone ...`");
  }
  const LAMMPS_NS::Atom& atom = *lmp.atom;
  const Surface surface(atom, lmp.world);
  for (int i = 0; i < atom.nlocal; ++i) {
    const double z = atom.x[i][2];
    const bool deep = zone.thickness_m > 0 && surface.above(atom.x[i]) - z > zone.thickness_m;
    mark->vector_atom[i] = z >= zone.above_m && !deep ? 1 : 0;
  }
  mark->do_forward_comm();
  // One pass over the pairs, with histories otherwise left alone, as in a set-up.
  lmp.update->setupflag = 1;
  lmp.force->pair->compute(0, 0);
  lmp.update->setupflag = 0;
  std::fill_n(mark->vector_atom, atom.nlocal + atom.nghost, 0.0);
}

double count_bonds(const LAMMPS_NS::LAMMPS& lmp) {
  auto& pair = static_cast<LAMMPS_NS::PairGran&>(*lmp.force->pair);
  const int offset = bond_history_offset(), width = pair.dnum();
  if (offset < 0) return 0;
  const LAMMPS_NS::NeighList &list = *pair.list, &history = *pair.listgranhistory;
  double bonds = 0;
  for (int k = 0; k < list.inum; ++k) {
    const int i = list.ilist[k];
    for (int n = 0; n < list.numneigh[i]; ++n) {
      if (history.firstdouble[i][width * n + offset] == 0) continue;
      bonds += (list.firstneigh[i][n] & NEIGHMASK) < lmp.atom->nlocal ? 1 : 0.5;
    }
  }
  return bonds;
}

}  // namespace dipper::dem
