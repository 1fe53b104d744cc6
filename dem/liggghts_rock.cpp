#include "dem/liggghts_rock.hpp"

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <fix_multisphere.h>
#include <fmt/core.h>
#include <input.h>
#include <integrate.h>
#include <lammps.h>
#include <modify.h>
#include <output.h>
#include <universe.h>
#include <update.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "common/sha256.hpp"
#include "dem/hold.hpp"
#include "dem/muck/crust.hpp"
#include "dem/muck/register_muck.hpp"
#include "dem/wall_motion.hpp"

namespace dipper::dem {

LiggghtsRock::LiggghtsRock(const RockSetup& setup, MPI_Comm comm) : setup_(setup), comm_(comm) {
  // The screen must be a file: with `-screen none` FixMesh prints to a null stream and crashes.
  std::vector<std::string> words = {"dipper-dem", "-log",  setup.log, "-screen",
                                    setup.screen, "-echo", "none"};
  for (const auto& [name, value] : setup.variables) {
    words.insert(words.end(), {"-var", name, value});
  }
  std::vector<char*> args;
  for (auto& w : words) args.push_back(w.data());
  register_muck();
  lmp_ = std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(args.size()), args.data(), comm);
  // LIGGGHTS opens the screen on rank 0 alone, yet every rank prints to it what is wrong with its
  // part of a mesh, and would crash. Not stderr: Error::all closes any screen but stdout.
  if (lmp_->comm->me != 0) lmp_->screen = stdout;
  lmp_->input->file(setup.deck.c_str());
  // The layer is held by what holds rock at rest; no other rock comes to rest at 0 m/s.
  if (setup_.layer && !setup_.hold) setup_.hold.emplace().below_m_s = 0;
  for (const auto& body : setup_.bodies) walls_.push_back(WallMotion::attach(lmp_.get(), body));
  X_WB_.resize(walls_.size());
}

LiggghtsRock::~LiggghtsRock() = default;

core::ServerInfo LiggghtsRock::info() const {
  core::ServerInfo info;
  info.version = fmt::format("LIGGGHTS {}, {} ranks", lmp_->universe->version, lmp_->comm->nprocs);
  info.bodies = setup_.bodies;
  for (const auto& s : setup_.scales) info.channels.push_back({s.name, "kg", "-"});
  info.channels.push_back({"rock_mass", "kg", "-"});
  info.channels.push_back({"rock_kinetic_energy", "J", "-"});
  info.channels.push_back({"rocks", "1", "-"});      // multispheres
  info.channels.push_back({"particles", "1", "-"});  // spheres, those of the rocks included
  if (setup_.hold) info.channels.push_back({"rock_parked", "kg", "-"});
  if (setup_.crust) info.channels.push_back({"bonds", "1", "-"});  // of the crust, unbroken
  if (!setup_.cleared.empty()) {  // at the start; 0 in the rows after a resume
    info.channels.push_back({"rocks_removed", "1", "-"});
    info.channels.push_back({"mass_removed", "kg", "-"});
  }
  info.timestep_s = lmp_->update->dt;
  return info;
}

core::RockState LiggghtsRock::place(const std::vector<Pose>& X_WB) {
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    setup_.resumed ? walls_[b]->adopt(X_WB[b], setup_.resumed->at(b)) : walls_[b]->place(X_WB[b]);
  }
  X_WB_ = X_WB;
  if (!setup_.resumed && !setup_.cleared.empty()) {
    cleared_ = clear_start(*lmp_, setup_.cleared, comm_);
    if (cleared_.rocks > 0 && lmp_->comm->me == 0)
      fmt::print("{:.0f} rocks, {:.0f} kg, overlapped a wall at the start and were removed\n",
                 cleared_.rocks, cleared_.mass_kg);
  }
  if (!setup_.resumed && setup_.layer) mark_layer(*lmp_, *setup_.layer);
  start();
  if (setup_.crust && !setup_.resumed) {
    form_crust(*lmp_, *setup_.crust);
    start();
  }
  return state();
}

void LiggghtsRock::start() {
  LAMMPS_NS::Update* update = lmp_->update;
  lmp_->input->one("run 0 post no");
  // From here on the time loop is entered directly: `run N` would zero the wall velocity and
  // print a thermo block each window. The end of the run is put out of reach, so that dump and
  // thermo output follow their own intervals across windows.
  update->whichflag = 1;
  update->firststep = update->beginstep = update->ntimestep;
  update->laststep = update->endstep = update->ntimestep + std::numeric_limits<int>::max();
  lmp_->output->init();
  lmp_->output->setup(0);
}

/// Told from the step alone, so that a resumed run knows whether the rock has come.
bool LiggghtsRock::rock_falls(std::int64_t n_steps) const {
  const std::int64_t now = lmp_->update->ntimestep;
  return setup_.fall && now <= setup_.fall->at_step && setup_.fall->at_step < now + n_steps;
}

void LiggghtsRock::let_rock_in() {
  if (hold_) hold_->release();
  hold_.reset();  // it counts the rock when it begins
  lmp_->input->file(setup_.fall->deck.c_str());
  start();
}

double LiggghtsRock::rock_mass() const { return weigh().at(setup_.scales.size()); }

void LiggghtsRock::check_rock_came(double mass_before_kg) const {
  const double came = rock_mass() - mass_before_kg, wanted = setup_.fall->mass_kg;
  if (lmp_->comm->me == 0)
    fmt::print("of {:.0f} kg of rock that come down, {:.0f} kg found room\n", wanted, came);
  if (came > 0.8 * wanted) return;
  throw std::runtime_error(
      fmt::format("of {:.0f} kg of rock that come down, {:.0f} kg found room; take a lower "
                  "collapse.height_m or a longer or wider bench",
                  wanted, came));
}

void LiggghtsRock::hold(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) {
  if (!hold_) hold_ = std::make_unique<HoldRock>(*lmp_, *setup_.hold, comm_);
  std::vector<MovingBody> bodies;
  const double window_s = static_cast<double>(n_steps) * lmp_->update->dt;
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    BodyBox box = walls_[b]->box();
    for (const auto& s : setup_.scales) {  // what is weighed with a body is never parked
      if (s.body != setup_.bodies[b]) continue;
      box.min_m = box.min_m.cwiseMin(s.min_m);
      box.max_m = box.max_m.cwiseMax(s.max_m);
    }
    bodies.push_back({box, X_WB_[b], twist_between(X_WB_[b], X_WB_target[b], window_s)});
  }
  hold_->before_window(n_steps, bodies);
}

core::RockState LiggghtsRock::step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) {
  const bool falls = rock_falls(n_steps);
  const double mass_before = falls ? rock_mass() : 0;
  if (falls) let_rock_in();
  if (setup_.hold && !falls) hold(n_steps, X_WB_target);
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    walls_[b]->begin_window(X_WB_target[b], static_cast<long>(n_steps));
  }
  lmp_->update->nsteps = static_cast<int>(n_steps);
  lmp_->update->integrate->run(static_cast<int>(n_steps));
  if (falls) check_rock_came(mass_before);
  return state();
}

core::RockState LiggghtsRock::state() {
  core::RockState s;
  s.step = lmp_->update->ntimestep;  // the deck starts counting at the run's start
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    s.bodies.push_back(walls_[b]->end_window());
    X_WB_[b] = s.bodies.back().X_WB;
  }
  s.channels = weigh();
  return s;
}

std::vector<double> LiggghtsRock::weigh() const {
  const std::size_t n = setup_.scales.size();
  // Most rock is far from every box: a sphere about each rejects it, without turning it into its
  // frame.
  struct Ball {
    Pose X_SW;
    Vector3d centre_W;
    double square;
  };
  std::vector<Ball> reach(n);
  for (std::size_t k = 0; k < n; ++k) {
    const auto& s = setup_.scales[k];
    const auto body = std::find(setup_.bodies.begin(), setup_.bodies.end(), s.body);
    const Pose X_WS = body == setup_.bodies.end() ? s.X_WS : X_WB_[body - setup_.bodies.begin()];
    reach[k] = {inverse(X_WS), X_WS * Vector3d((s.min_m + s.max_m) / 2),
                1.0001 * (s.max_m - s.min_m).squaredNorm() / 4};
  }
  std::vector<double> sums(n + (setup_.hold ? 5 : 4), 0.0);
  const auto count = [&](const double* x, const double* v, double mass) {
    const Vector3d p_W = Eigen::Map<const Vector3d>(x);
    for (std::size_t k = 0; k < n; ++k) {
      if ((p_W - reach[k].centre_W).squaredNorm() > reach[k].square) continue;
      const Vector3d p_S = reach[k].X_SW * p_W;
      const auto& s = setup_.scales[k];
      if ((p_S.array() >= s.min_m.array()).all() && (p_S.array() <= s.max_m.array()).all()) {
        sums[k] += mass;
      }
    }
    sums[n] += mass;
    sums[n + 1] += 0.5 * mass * Eigen::Map<const Vector3d>(v).squaredNorm();
  };

  auto* fix = lmp_->modify->find_fix_style("multisphere", 0);
  auto* rocks = static_cast<LAMMPS_NS::FixMultisphere*>(fix);
  const LAMMPS_NS::Atom* atom = lmp_->atom;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (rocks == nullptr || rocks->belongs_to(i) < 0) {
      count(atom->x[i], atom->v[i], atom->rmass[i]);
    }
  }
  if (rocks != nullptr) {
    auto& data = rocks->data();
    sums[n + 2] = data.n_body();
    for (int b = 0; b < data.n_body(); ++b) {
      double x[3], v[3];
      data.xcm(x, b);
      data.vcm(v, b);
      count(x, v, data.mass(b));
    }
  }
  sums[n + 3] = atom->nlocal;
  if (hold_) {
    for (const auto& m : hold_->parked()) {
      const double still[3] = {0, 0, 0};
      count(m.p_W.data(), still, m.mass_kg);
      sums[n + 2] += m.packed.empty() ? 0 : 1;
      sums[n + 4] += m.mass_kg;
    }
    sums[n + 3] += static_cast<double>(hold_->spheres_parked());
  }
  if (setup_.crust) sums.push_back(count_bonds(*lmp_));
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                comm_);
  if (!setup_.cleared.empty()) sums.insert(sums.end(), {cleared_.rocks, cleared_.mass_kg});
  return sums;
}

void LiggghtsRock::save(const std::filesystem::path& file) {
  // What a resumed run does not know, the run that goes on forgets: start() begins anew.
  if (hold_) hold_->release();
  hold_.reset();
  lmp_->input->one(("write_restart " + file.string()).c_str());
  // The command moves atoms between ranks, so lists and forces have to be set up again, just as
  // they are in a run that goes on from the file.
  start();
}

void LiggghtsRock::load(const std::filesystem::path&) {
  // LIGGGHTS reads a restart file only into an empty simulation: a resumed run starts this process
  // with a deck that reads the checkpoint.
  throw std::logic_error("LIGGGHTS cannot load a checkpoint into a running simulation");
}

std::string LiggghtsRock::state_hash() {
  if (hold_) hold_->release();
  struct Particle {
    double id;
    double state[6];
  };
  const LAMMPS_NS::Atom* atom = lmp_->atom;
  std::vector<Particle> mine(atom->nlocal);
  for (int i = 0; i < atom->nlocal; ++i) {
    mine[i].id = atom->tag[i];
    std::copy_n(atom->x[i], 3, mine[i].state);
    std::copy_n(atom->v[i], 3, mine[i].state + 3);
  }
  const int bytes = static_cast<int>(mine.size() * sizeof(Particle));
  std::vector<int> counts(lmp_->comm->nprocs), offsets(lmp_->comm->nprocs, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<Particle> all((offsets.back() + counts.back()) / sizeof(Particle));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE,
                 comm_);
  std::sort(all.begin(), all.end(),
            [](const Particle& a, const Particle& b) { return a.id < b.id; });
  if (hold_) hold_->hold_layer();
  return sha256({reinterpret_cast<const char*>(all.data()), all.size() * sizeof(Particle)});
}

}  // namespace dipper::dem
