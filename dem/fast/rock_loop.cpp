#include "dem/fast/rock_loop.hpp"

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <fix_multisphere.h>
#include <force.h>
#include <lammps.h>
#include <modify.h>
#include <output.h>
#include <pair.h>
#include <signal_handling.h>
#include <update.h>

#include "dem/fast/near_lists.hpp"
#include "dem/fast/pair_forces.hpp"
#include "dem/fast/rock_order.hpp"
#include "dem/fast/wall_history.hpp"

namespace dipper::dem {
namespace {

constexpr LAMMPS_NS::bigint kOrderEvery = 1000;  // steps, as LIGGGHTS

}  // namespace

void speed_up(LAMMPS_NS::LAMMPS& lmp) {
  auto* lists = new NearLists(&lmp);
  delete lmp.neighbor;
  lmp.neighbor = lists;
  delete lmp.update->integrate;
  lmp.update->integrate = new RockLoop(&lmp, *lists);
  register_pair_forces();
  use_wall_history();
}

RockLoop::RockLoop(LAMMPS_NS::LAMMPS* l, NearLists& lists)
    : Verlet(l, 0, nullptr), lmp_(*l), lists_(lists), motion_(*l) {}

void RockLoop::init() {
  own_ = motion_.take_over();
  if (own_) atom->sortfreq = 0;
  next_order_ = update->ntimestep == 0 ? 0 : (update->ntimestep / kOrderEvery + 1) * kOrderEvery;
  Verlet::init();
}

void RockLoop::run(int n) {
  if (!own_) return Verlet::run(n);
  const LAMMPS_NS::bigint last = update->ntimestep + n;
  motion_.gather();
  while (update->ntimestep < last) {
    const LAMMPS_NS::bigint step = ++update->ntimestep;
    ev_set(step);
    const bool virial = vflag != 0;

    if (modify->n_pre_initial_integrate) modify->pre_initial_integrate();
    if (virial)
      motion_.library_initial_integrate(vflag);
    else
      lists_.moved(motion_.initial_integrate() * update->dt);
    modify->initial_integrate(vflag);
    if (modify->n_post_integrate) modify->post_integrate();

    if (neighbor->decide() != 0)
      renew_lists();
    else
      motion_.forward();

    force_clear();
    if (modify->n_pre_force) modify->pre_force(vflag);
    if (pair_compute_flag) force->pair->compute(eflag, vflag);
    if (modify->n_post_force) modify->post_force(vflag);

    if (modify->n_pre_final_integrate) modify->pre_final_integrate();
    if (virial)
      motion_.library_final_integrate(vflag);
    else
      motion_.final_integrate(step == last || step == output->next || modify->n_end_of_step > 0);
    modify->final_integrate();
    if (modify->n_end_of_step) modify->end_of_step();
    if (step == output->next) output->write(step);
    if (SignalHandler::request_quit && !SignalHandler::request_write_restart) break;
  }
  motion_.finish();
}

void RockLoop::renew_lists() {
  if (modify->n_pre_exchange) modify->pre_exchange();
  domain->pbc();
  if (domain->box_change) {
    domain->reset_box();
    comm->setup();
    if (neighbor->style) neighbor->setup_bins();
  }
  comm->exchange();
  if (update->ntimestep >= next_order_) {
    order_rock(lmp_, motion_.bodies());
    next_order_ = (update->ntimestep / kOrderEvery + 1) * kOrderEvery;
  }
  comm->borders();
  if (modify->n_pre_neighbor) modify->pre_neighbor();
  neighbor->build();
  motion_.gather();
}

}  // namespace dipper::dem
