#include "dem/hold.hpp"

#include <atom.h>
#include <fix_multisphere.h>
#include <fix_nve_sphere.h>
#include <fmt/format.h>
#include <group.h>
#include <input.h>
#include <integrate.h>
#include <lammps.h>
#include <modify.h>
#include <neighbor.h>
#include <output.h>
#include <update.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "common/gravity.hpp"
#include "dem/all_ranks.hpp"
#include "dem/rest_group.hpp"
#include "dem/rock_dump.hpp"

namespace dipper::dem {
namespace {

constexpr double kStruck = 5;  // times the change of load that wakes a rock: an impact

Vector3d vector(const double* p) { return Eigen::Map<const Vector3d>(p); }

void write_record(const HeldRecord& r, ByteWriter& out) {
  out.put(r.of_layer);
  out.put(r.groups);
  for (const Vector3d* v : {&r.carried_N, &r.excess_N, &r.seen_p_W})
    for (int k = 0; k < 3; ++k) out.put((*v)[k]);
  out.put(r.seen_step);
}

HeldRecord read_record(ByteReader& in) {
  HeldRecord r;
  r.of_layer = in.get<bool>();
  r.groups = in.get<int>();
  for (Vector3d* v : {&r.carried_N, &r.excess_N, &r.seen_p_W})
    for (int k = 0; k < 3; ++k) (*v)[k] = in.get<double>();
  r.seen_step = in.get<std::int64_t>();
  return r;
}

}  // namespace

void mark_layer(LAMMPS_NS::LAMMPS& lmp, const setup::HeldLayer& layer) {
  lmp.input->one(fmt::format("group {} subtract all all", kLayerGroup).c_str());
  const int bit = lmp.group->bitmask[lmp.group->find(kLayerGroup)];
  const RockNumbers numbers(lmp);
  std::vector<char> within(numbers.size(), 0);
  const auto look = [&](std::size_t rock, const Vector3d& p) {
    within[rock] = p.z() < layer.depth_m || p.x() > layer.rear_x_m - layer.depth_m ||
                   std::abs(p.y()) > layer.half_width_m - layer.depth_m;
  };
  LAMMPS_NS::Atom* atom = lmp.atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    const std::size_t rock = numbers.of_sphere(atom->tag[i]);
    if (rock == static_cast<std::size_t>(atom->tag[i])) look(rock, vector(atom->x[i]));
  }
  auto* fix = lmp.modify->find_fix_style("multisphere", 0);
  if (auto* bodies = static_cast<LAMMPS_NS::FixMultisphere*>(fix)) {
    auto& data = bodies->data();
    for (int b = 0; b < data.n_body(); ++b) {
      Vector3d x;
      data.xcm(x.data(), b);
      look(numbers.of_body(data.tag(b)), x);
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, within.data(), static_cast<int>(within.size()), MPI_BYTE, MPI_BOR,
                lmp.world);
  for (int i = 0; i < atom->nlocal; ++i)
    if (within[numbers.of_sphere(atom->tag[i])] != 0) atom->mask[i] |= bit;
}

HoldRock::HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm,
                   RockNumbers numbers)
    : lmp_(lmp),
      bodies_(multisphere_of(lmp)),
      settings_(settings),
      comm_(comm),
      numbers_(std::move(numbers)),
      dump_(RockDump::of(lmp)),
      parked_(lmp, numbers_, dump_),
      policy_(settings, numbers_.size()),
      rocks_(numbers_.size()),
      checked_(lmp.update->ntimestep),
      gathered_(lmp.update->ntimestep),
      followed_(lmp.update->ntimestep) {
  for (int k = 0; k < lmp.modify->nfix; ++k) {
    const LAMMPS_NS::Fix* fix = lmp.modify->fix[k];
    if (std::strcmp(fix->style, "nve/sphere") != 0) continue;
    if (fix->igroup == 0)
      throw std::runtime_error(
          "rock at rest can be held only where `fix nve/sphere` has a group of its own, not all");
    integrated_ |= fix->groupbit;
  }
  if (const int group = lmp.group->find(kLayerGroup); group >= 0)
    layer_ = lmp.group->bitmask[group];
  if (lmp.group->find(kRestGroup) < 0)  // else it came with a restart file, with its members
    lmp.input->one(fmt::format("group {} subtract all all", kRestGroup).c_str());
  resting_ = rest_bit(lmp);
}

HoldRock::HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm)
    : HoldRock(lmp, settings, comm, RockNumbers(lmp)) {
  // For every rock, joined over the ranks: its integrators' bits and the layer's.
  std::vector<int> bits(numbers_.size(), 0);
  for (int i = 0; i < lmp_.atom->nlocal; ++i) {
    largest_m_ = std::max(largest_m_, lmp_.atom->radius[i]);
    bits[numbers_.of_sphere(lmp_.atom->tag[i])] |= lmp_.atom->mask[i] & (integrated_ | layer_);
  }
  MPI_Allreduce(MPI_IN_PLACE, bits.data(), static_cast<int>(bits.size()), MPI_INT, MPI_BOR, comm_);
  MPI_Allreduce(MPI_IN_PLACE, &largest_m_, 1, MPI_DOUBLE, MPI_MAX, comm_);
  for (std::size_t k = 0; k < bits.size(); ++k) {
    rocks_[k].groups = bits[k] & integrated_;
    rocks_[k].of_layer = (bits[k] & layer_) != 0;
  }
  hold_layer();
}

HoldRock::HoldRock(LAMMPS_NS::LAMMPS& lmp, const setup::HoldSettings& settings, MPI_Comm comm,
                   ByteReader& in)
    : HoldRock(lmp, settings, comm, RockNumbers(in)) {
  parked_.load(in);
  policy_.restore(in.get_all<RestRecord>());
  for (HeldRecord& rock : rocks_) rock = read_record(in);
  largest_m_ = in.get<double>();
  checked_ = in.get<std::int64_t>();
  gathered_ = in.get<std::int64_t>();
  followed_ = in.get<std::int64_t>();
  park_again_ = in.get<bool>();
}

void HoldRock::save(ByteWriter& out) const {
  numbers_.save(out);
  parked_.save(out);
  out.put_all(policy_.records());
  for (const HeldRecord& rock : rocks_) write_record(rock, out);
  out.put(largest_m_);
  out.put(checked_);
  out.put(gathered_);
  out.put(followed_);
  out.put(park_again_);
}

/// Calls visit(facts, centre, radius) for every rock of this rank in LIGGGHTS.
template <typename Visit>
void HoldRock::for_each_rock(const Visit& visit) const {
  const LAMMPS_NS::Atom* atom = lmp_.atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (bodies_ != nullptr && bodies_->belongs_to(i) >= 0) continue;
    const Facts f{false,
                  i,
                  static_cast<std::size_t>(atom->tag[i]),
                  vector(atom->v[i]),
                  vector(atom->f[i]),
                  atom->rmass[i] * kGravity_m_s2};
    visit(f, vector(atom->x[i]), atom->radius[i]);
  }
  if (bodies_ == nullptr) return;
  auto& data = bodies_->data();
  double** force = data.extract_double_vector("fcm");
  for (int b = 0; b < data.n_body(); ++b) {
    Vector3d x, v;
    data.xcm(x.data(), b);
    data.vcm(v.data(), b);
    const Facts f{
        true, b, numbers_.of_body(data.tag(b)), v, vector(force[b]), data.mass(b) * kGravity_m_s2};
    visit(f, x, data.r_bound(b));
  }
}

void HoldRock::join_flags() {
  std::vector<std::uint8_t> flags = policy_.flags();
  MPI_Allreduce(MPI_IN_PLACE, flags.data(), static_cast<int>(flags.size()), MPI_BYTE, MPI_BOR,
                comm_);
  policy_.set_flags(flags);
}

void HoldRock::follow_loads(double dt_s) {
  const double part = std::min(1.0, dt_s / settings_.average_s);
  for_each_rock([&](const Facts& f, const auto&...) {
    HeldRecord& rock = rocks_[f.rock];
    if (policy_.of(f.rock) != Rest::held || rock.of_layer) return;
    rock.excess_N += part * (f.force + rock.carried_N - rock.excess_N);
    const double limit = settings_.unbalance * f.weight;
    const double excess = rock.excess_N.norm();
    if (excess > limit) policy_.flag(f.rock, rest_flag::disturbed);
    if (excess > kStruck * limit) policy_.flag(f.rock, rest_flag::struck);
  });
}

void HoldRock::look_at_motion(double dt_s) {
  for_each_rock([&](const Facts& f, const Vector3d& x, const auto&...) {
    // Rock that was on another rank is judged by its speed: rock that crosses the boundary to and
    // fro would otherwise never come to rest.
    HeldRecord& rock = rocks_[f.rock];
    const bool seen = rock.seen_step == gathered_;
    const double way = seen ? (x - rock.seen_p_W).norm() : f.v_W.norm() * dt_s;
    const bool calm = settings_.below_m_s > 0 && way <= settings_.below_m_s * dt_s;
    rock.seen_p_W = x;
    rock.seen_step = lmp_.update->ntimestep;
    if (policy_.of(f.rock) == Rest::moving && !calm) policy_.flag(f.rock, rest_flag::busy);
  });
}

void HoldRock::look(const std::vector<WallZone>& near, const std::vector<WallZone>& soon) {
  const auto within = [](const std::vector<WallZone>& zones, const Vector3d& p, double r) {
    return std::any_of(zones.begin(), zones.end(),
                       [&](const WallZone& z) { return z.holds(p, r); });
  };
  const auto flag = [&](std::size_t rock, const Vector3d& p, double r) {
    if (!within(soon, p, r)) return;
    policy_.flag(rock, rest_flag::soon);
    if (within(near, p, r)) policy_.flag(rock, rest_flag::near);
  };
  for_each_rock([&](const Facts& f, const Vector3d& x, double r) { flag(f.rock, x, r); });
  for (const auto& s : parked_.spheres()) flag(s.rock, s.p_W, s.radius_m);
}

Reach HoldRock::moving(const std::vector<Rest>& rest, double gap_m, double ahead_s) const {
  const LAMMPS_NS::Atom* atom = lmp_.atom;
  std::vector<Mover> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (rest[numbers_.of_sphere(atom->tag[i])] != Rest::moving) continue;
    const double* x = atom->x[i];
    const double r = atom->radius[i];
    const Vector3d way = vector(atom->v[i]) * ahead_s;
    const int samples = static_cast<int>(std::ceil(way.norm() / (r + gap_m)));
    mine.push_back({x[0], x[1], x[2], r, gap_m});
    for (int k = 1; k <= samples; ++k) {
      const Vector3d p = vector(x) + way * k / samples;
      mine.push_back({p.x(), p.y(), p.z(), r, gap_m});
    }
  }
  for (const auto& s : parked_.spheres())
    if (rest[s.rock] == Rest::moving)
      mine.push_back({s.p_W.x(), s.p_W.y(), s.p_W.z(), s.radius_m, gap_m});
  return {of_all_ranks(mine, comm_), largest_m_};
}

void HoldRock::expose(const std::vector<Rest>& rest, const Reach& reach) {
  const LAMMPS_NS::Atom* atom = lmp_.atom;
  policy_.keep_flags(static_cast<std::uint8_t>(~rest_flag::exposed));
  for (int i = 0; i < atom->nlocal; ++i) {
    const std::size_t rock = numbers_.of_sphere(atom->tag[i]);
    if (rest[rock] != Rest::moving && reach.touches(vector(atom->x[i]), atom->radius[i]))
      policy_.flag(rock, rest_flag::exposed);
  }
  for (const auto& s : parked_.spheres())
    if (rest[s.rock] != Rest::moving && reach.touches(s.p_W, s.radius_m))
      policy_.flag(s.rock, rest_flag::exposed);
  join_flags();
}

void HoldRock::before_window(std::int64_t n_steps, const std::vector<MovingBody>& bodies) {
  const std::int64_t now = lmp_.update->ntimestep;
  const double dt = lmp_.update->dt;
  follow_loads(static_cast<double>(now - std::exchange(followed_, now)) * dt);
  const bool frame = all_rock_is_written(now, now + n_steps);
  if (frame) unpark();
  if (static_cast<double>(now - checked_) * dt < settings_.check_s) return;
  if (!frame) checked_ = now;  // otherwise the next window parks again

  std::vector<WallZone> near, soon;
  for (const auto& b : bodies) {
    near.emplace_back(b.box, b.X_WB, b.V_WB_W, 2 * settings_.check_s, settings_.margin_m);
    soon.emplace_back(b.box, b.X_WB, b.V_WB_W, settings_.ahead_s, 1.2 * settings_.margin_m);
  }
  look(near, soon);
  // Rock that moves until the next check, with a margin: lists reach over the skin.
  const std::vector<Rest> at_rest = policy_.all();
  expose(at_rest, moving(at_rest, lmp_.neighbor->skin, 2 * settings_.check_s));
  const bool alarm = policy_.alarms();
  const double since = static_cast<double>(now - gathered_) * dt;
  const bool gather = since >= settings_.gather_s;
  if (gather) {
    look_at_motion(since);
    join_flags();
    policy_.observe(since);
    gathered_ = now;
  }
  if (alarm || gather || park_again_) {
    std::vector<Rest> next = policy_.decide();
    expose(next, moving(next, settings_.layer_m, settings_.sight_s));
    if (!frame) policy_.park(next);
    // Lists are rebuilt for a change, but not for a few more rocks at rest.
    const auto in_lists = static_cast<std::size_t>(
        std::count_if(at_rest.begin(), at_rest.end(), [](Rest r) { return r != Rest::parked; }));
    if (alarm || policy_.changes(next) > in_lists / 50) {
      for (std::size_t r = 0; r < next.size(); ++r)
        if (next[r] == Rest::moving) rocks_[r].of_layer = false;
      apply(std::move(next));
      park_again_ = frame;
    }
  }
  // A disturbed rock stays so until the next check.
  const std::uint8_t keep = gather ? 0 : rest_flag::disturbed;
  policy_.keep_flags(keep);
}

bool HoldRock::all_rock_is_written(std::int64_t from, std::int64_t until) const {
  LAMMPS_NS::Output& output = *lmp_.output;
  for (int k = 0; k < output.ndump; ++k) {
    const LAMMPS_NS::Dump* dump = output.dump[k];
    const bool of_walls = std::strncmp(dump->style, "mesh/", 5) == 0;
    if (output.next_dump[k] <= until && dump != dump_ && !of_walls) return true;
  }
  bool restart = false;
  for (std::int64_t step = from; step < until; ++step)
    restart = restart || output.restart_requested(step + 1);
  return restart;
}

void HoldRock::unpark() {
  std::vector<Rest> all = policy_.all();
  std::replace(all.begin(), all.end(), Rest::parked, Rest::held);
  if (policy_.changes(all) > 0) apply(std::move(all));
  park_again_ = true;
}

void HoldRock::release() {
  const std::vector<Rest> all(numbers_.size(), Rest::moving);
  if (policy_.changes(all) > 0) apply(all);
  policy_.keep_flags(0);
}

void HoldRock::hold_layer() {
  std::vector<Rest> rest = policy_.all();
  for (std::size_t r = 0; r < rest.size(); ++r)
    if (rocks_[r].of_layer && rest[r] == Rest::moving) rest[r] = Rest::held;
  if (policy_.changes(rest) > 0) apply(std::move(rest));
}

void HoldRock::apply(std::vector<Rest> rest) {
  // A held rock's load is the sum of its contacts. When contacts leave the lists and return, their
  // forces are compensated, so that the sum is the change since the rock came to rest.
  std::vector<Vector3d> before(numbers_.size(), Vector3d::Zero());
  std::vector<bool> was_held(numbers_.size(), false);
  for_each_rock([&](const Facts& f, const auto&...) {
    was_held[f.rock] = policy_.of(f.rock) == Rest::held;
    before[f.rock] = f.force + rocks_[f.rock].carried_N;
  });
  lmp_.modify->setup_pre_exchange();  // contact history goes from the lists to the spheres
  set_held(rest);
  parked_.change(rest);
  set_held(rest);
  lmp_.update->integrate->setup_minimal(1);
  for_each_rock([&](const Facts& f, const auto&...) {
    if (rest[f.rock] != Rest::held) return;
    const Vector3d load = was_held[f.rock] ? before[f.rock] : Vector3d::Zero();
    rocks_[f.rock].carried_N = load - f.force;
    if (!was_held[f.rock]) rocks_[f.rock].excess_N.setZero();
  });
  policy_.adopt(rest);
}

void HoldRock::set_held(const std::vector<Rest>& rest) {
  LAMMPS_NS::Atom* atom = lmp_.atom;
  bool yes[] = {true, true, true}, no[] = {false, false, false};
  double zero[] = {0, 0, 0};
  for (int i = 0; i < atom->nlocal; ++i) {
    const std::size_t rock = numbers_.of_sphere(atom->tag[i]);
    if (!rocks_[rock].of_layer) atom->mask[i] &= ~layer_;
    if (rest[rock] == Rest::moving) {
      atom->mask[i] = (atom->mask[i] | rocks_[rock].groups) & ~resting_;
      continue;
    }
    atom->mask[i] = (atom->mask[i] & ~integrated_) | resting_;
    std::fill_n(atom->v[i], 3, 0.0);
    std::fill_n(atom->omega[i], 3, 0.0);
  }
  if (bodies_ == nullptr) return;
  auto& data = bodies_->data();
  for (int b = 0; b < data.n_body(); ++b) {
    const std::size_t rock = numbers_.of_body(data.tag(b));
    const bool moves = rest[rock] == Rest::moving;
    if (moves && policy_.of(rock) == Rest::moving) continue;
    data.set_fflag(b, moves ? yes : no);
    data.set_tflag(b, moves ? yes : no);
    data.set_v_body(b, zero);
    data.set_omega_body(b, zero);
    data.set_angmom_body(b, zero);
  }
}

}  // namespace dipper::dem
