#include "dem/liggghts_rock.hpp"

#include <atom.h>
#include <comm.h>
#include <fmt/core.h>
#include <input.h>
#include <lammps.h>
#include <universe.h>
#include <update.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "common/sha256.hpp"
#include "dem/all_ranks.hpp"
#include "dem/clear_start.hpp"
#include "dem/collapse.hpp"
#include "dem/contact_pause.hpp"
#include "dem/error_screen.hpp"
#include "dem/fast/rock_loop.hpp"
#include "dem/holding.hpp"
#include "dem/moist/crust.hpp"
#include "dem/moist/register_moist.hpp"
#include "dem/rock_dump.hpp"
#include "dem/rock_image.hpp"
#include "dem/rock_look.hpp"
#include "dem/time_loop.hpp"
#include "dem/wall_motion.hpp"
#include "dem/weighing.hpp"

namespace dipper::dem {

LiggghtsRock::LiggghtsRock(const setup::RockSetup& setup, MPI_Comm comm) : setup_(setup) {
  // The screen must be a file: with `-screen none` FixMesh prints to a null stream and crashes.
  std::vector<std::string> words = {"dipper-dem", "-log",  setup.log, "-screen",
                                    setup.screen, "-echo", "none"};
  for (const auto& [name, value] : setup.variables) {
    words.insert(words.end(), {"-var", name, value});
  }
  std::vector<char*> args;
  for (auto& w : words) args.push_back(w.data());
  register_moist();
  lmp_ = std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(args.size()), args.data(), comm);
  if (setup.fast_loop) speed_up(*lmp_);
  show_errors_of_all_ranks(*lmp_);
  lmp_->input->file(setup.deck.c_str());
  for (const auto& body : setup_.bodies) walls_.push_back(WallMotion::attach(lmp_.get(), body));
  X_WB_.resize(walls_.size());

  std::unique_ptr<Holding> holding;
  if (setup_.hold || setup_.layer) holding = std::make_unique<Holding>(*lmp_, setup_, walls_);
  holding_ = holding.get();
  features_.push_back(std::make_unique<Weighing>(*lmp_, setup_, holding_));
  if (holding) features_.push_back(std::move(holding));
  if (setup_.crust) features_.push_back(std::make_unique<Crust>(*lmp_, *setup_.crust));
  if (setup_.fall) features_.push_back(std::make_unique<Collapse>(*lmp_, *setup_.fall));
  if (!setup_.cleared.empty())
    features_.push_back(std::make_unique<ClearStart>(*lmp_, setup_.cleared));
  if (setup_.pauses) features_.push_back(std::make_unique<ContactPause>(*lmp_, setup_, walls_));
}

LiggghtsRock::~LiggghtsRock() = default;

core::ServerInfo LiggghtsRock::info() const {
  core::ServerInfo info;
  info.version = fmt::format("LIGGGHTS {}, {} ranks", lmp_->universe->version, lmp_->comm->nprocs);
  info.bodies = setup_.bodies;
  for (const auto& feature : features_) {
    const std::vector<core::Channel> own = feature->channels();
    info.channels.insert(info.channels.end(), own.begin(), own.end());
  }
  info.timestep_s = lmp_->update->dt;
  return info;
}

core::RockState LiggghtsRock::place(const std::vector<Pose>& X_WB) {
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    setup_.resumed ? walls_[b]->adopt(X_WB[b], setup_.resumed->at(b)) : walls_[b]->place(X_WB[b]);
  }
  X_WB_ = X_WB;
  RockDump::of(*lmp_);
  if (!setup_.resumed)
    for (const auto& feature : features_) feature->before_set_up();
  else
    keep_frames(*lmp_);
  set_up_time_loop(*lmp_);
  if (setup_.resumed && !setup_.image.empty()) resume_from(setup_.image);
  if (!setup_.resumed)
    for (const auto& feature : features_)
      if (feature->after_set_up()) set_up_time_loop(*lmp_);
  return state();
}

core::RockState LiggghtsRock::step(const core::RockStep& step) {
  if (!step.contact && !setup_.pauses)
    throw std::runtime_error(
        "the bodies' contact is to pause, but the set-up does not allow pauses");
  RockWindow window{lmp_->update->ntimestep, step.n_steps, X_WB_, step.X_WB_target, step.contact};
  window.all_rock_in = std::any_of(features_.begin(), features_.end(), [&](const auto& feature) {
    return feature->needs_all_rock(window);
  });
  if (window.all_rock_in)
    for (const auto& feature : features_) feature->release();
  for (const auto& feature : features_) feature->before_window(window);
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    walls_[b]->begin_window(step.X_WB_target[b], static_cast<long>(step.n_steps));
  }
  run_steps(*lmp_, step.n_steps);
  for (const auto& feature : features_) feature->after_window(window);
  return state();
}

core::RockState LiggghtsRock::state() {
  core::RockState s;
  s.step = lmp_->update->ntimestep;  // the deck starts counting at the run's start
  for (std::size_t b = 0; b < walls_.size(); ++b) {
    s.bodies.push_back(walls_[b]->end_window());
    X_WB_[b] = s.bodies.back().X_WB;
  }
  for (const auto& feature : features_) feature->measure(X_WB_, s.channels);
  MPI_Allreduce(MPI_IN_PLACE, s.channels.data(), static_cast<int>(s.channels.size()), MPI_DOUBLE,
                MPI_SUM, lmp_->world);
  return s;
}

void LiggghtsRock::save(const std::filesystem::path& file) {
  write_restart_untouched(*lmp_, file);
  write_image(setup::image_of(file), *lmp_, [&](ByteWriter& out) {
    put_rock(*lmp_, out);
    for (const WallMotion* wall : walls_) wall->save(out);
    for (const auto& feature : features_) feature->save(out);
  });
}

void LiggghtsRock::resume_from(const std::filesystem::path& file) {
  ByteReader in = read_image(file, *lmp_);
  try {
    get_rock(*lmp_, in);
    for (WallMotion* wall : walls_) wall->load(in);
    for (const auto& feature : features_) feature->load(in);
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(file.string() + ": " + e.what());
  }
}

HeightMap LiggghtsRock::look(const HeightGrid& grid) { return look_at_rock(*lmp_, holding_, grid); }

std::string LiggghtsRock::state_hash() {
  if (holding_ != nullptr) holding_->wake_all();
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
  std::vector<Particle> all = of_all_ranks(mine, lmp_->world);
  std::sort(all.begin(), all.end(),
            [](const Particle& a, const Particle& b) { return a.id < b.id; });
  if (holding_ != nullptr) holding_->hold_layer();
  return sha256({reinterpret_cast<const char*>(all.data()), all.size() * sizeof(Particle)});
}

}  // namespace dipper::dem
