#include "coupler/run/paired_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "common/case_lines.hpp"
#include "common/mesh/stl.hpp"
#include "common/record/record.hpp"
#include "common/sha256.hpp"
#include "common/version.hpp"
#include "coupler/case/case_hash.hpp"
#include "coupler/core/coupling.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/deck/deck.hpp"
#include "coupler/launch/interrupt.hpp"
#include "coupler/run/achieved_grading.hpp"
#include "coupler/run/achieved_profile.hpp"
#include "coupler/run/checkpoint.hpp"
#include "coupler/run/dump_index.hpp"
#include "coupler/run/observed.hpp"
#include "coupler/run/pile.hpp"
#include "coupler/run/progress.hpp"
#include "coupler/run/run_record.hpp"
#include "coupler/run/summary.hpp"
#include "coupler/sides/sides.hpp"
#include "coupler/sides/sides_setup.hpp"
#include "machine/motion.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

/// The rock, and how long the master waited for it.
class TimedRock final : public core::Rock {
 public:
  explicit TimedRock(core::Rock& rock) : rock_(rock) {}
  core::ServerInfo info() const override { return rock_.info(); }
  core::RockState place(const std::vector<Pose>& X_WB) override { return rock_.place(X_WB); }
  core::RockState step(std::int64_t n_steps, const std::vector<Pose>& X_WB_target) override {
    const auto began = Clock::now();
    core::RockState s = rock_.step(n_steps, X_WB_target);
    wait_s_ += seconds_since(began);
    return s;
  }
  void save(const fs::path& file) override { rock_.save(file); }
  void load(const fs::path& file) override { rock_.load(file); }
  std::string state_hash() override { return rock_.state_hash(); }
  double wait_s() const { return wait_s_; }

 private:
  core::Rock& rock_;
  double wait_s_ = 0;
};

/// The run's folder and what is in it.
struct RunFolder {
  explicit RunFolder(const fs::path& folder) : root(fs::absolute(folder)) {
    for (const auto& sub : {deck(), dumps(), checkpoints(), logs()}) fs::create_directories(sub);
    fs::permissions(logs(), fs::perms::owner_all);  // they hold the secret of the run's messages
  }
  fs::path deck() const { return root / "deck"; }
  fs::path dumps() const { return root / "dumps"; }
  fs::path checkpoints() const { return root / "checkpoints"; }
  fs::path logs() const { return root / "logs"; }
  fs::path record() const { return root / "record.h5"; }
  fs::path summary() const { return root / "summary.json"; }
  fs::path root;
};

/// One leg of a run, from the start or a checkpoint to the end, an interruption or a failure.
class Leg {
 public:
  Leg(const cases::Case& c, const RunOptions& options)
      : case_(c),
        folder_(options.out),
        from_(options.resume ? last_checkpoint(folder_.checkpoints()) : std::nullopt) {
    const machine::Motion motion = machine::Motion::load(c.machine.motion);
    const double end_s = c.end_s > 0 ? c.end_s : static_cast<double>(motion.end_ns()) * 1e-9;
    end_step_ = std::llround(end_s / c.dem.timestep_s);
    shovel_ = sides::read_mesh_facts(c);
    layers_ = sides::dipper_layers(c, shovel_.dipper.cavity);
    facts_.case_name = c.name;
    facts_.seed = c.seed;
    facts_.scheme = c.coupling.scheme;
    facts_.effects = c.effects;
    facts_.timestep_s = c.dem.timestep_s;
    facts_.struck_volume_m3 = shovel_.dipper.struck_volume_m3;
    facts_.bulk_density_kg_m3 =
        c.rock.bulk_density_kg_m3 * deck::laden_density(c) / c.rock.density_kg_m3;
    if (from_) {
      dem_step_ = from_->dem_step;
      facts_.syncs = from_->step_index;
      facts_.dem_cpu_s = from_->dem_cpu_s;
      facts_.mbs_cpu_s = from_->mbs_cpu_s;
    }
  }

  Outcome run() {
    try {
      prepare();
      drive();
    } catch (const launch::Interrupted&) {
      facts_.status = "interrupted";
    } catch (const transport::PeerError& e) {
      facts_.status = "failed";
      facts_.failure = fmt::format("the {} side failed at t = {:.4f} s (sync step {}): {}", e.side,
                                   time_s(), facts_.syncs, e.what());
    } catch (const std::exception& e) {
      facts_.status = "failed";
      facts_.failure =
          fmt::format("at t = {:.4f} s (sync step {}): {}", time_s(), facts_.syncs, e.what());
    }
    return finish();
  }

 private:
  double time_s() const { return static_cast<double>(dem_step_) * case_.dem.timestep_s; }

  void prepare() {
    cases::Case as_built = case_;
    if (layers_.mesh) {
      as_built.bodies["dipper"] = folder_.deck() / "dipper.stl";
      std::ofstream(as_built.bodies["dipper"]) << mesh::to_stl("dipper", *layers_.mesh);
    }
    deck::write_deck(as_built, case_.rock.shape_folder, folder_.deck());
    std::ofstream(folder_.root / "case.txt") << case_.text;
    fmt::print("{}: {:.2f} s, {} windows of {} steps, {} rank{}\n", case_.name,
               static_cast<double>(end_step_) * case_.dem.timestep_s,
               (end_step_ + case_.coupling.sync_steps - 1) / case_.coupling.sync_steps,
               case_.coupling.sync_steps, case_.dem.ranks, case_.dem.ranks == 1 ? "" : "s");
    fs::path restart;
    if (from_) {
      restart = from_->rock();
      fmt::print("going on from t = {:.3f} s\n", time_s());
    } else {
      fmt::print("pile: looking in the cache, else settling\n");
      std::fflush(stdout);
      const Pile pile = settled_pile(case_, folder_.deck(), folder_.logs());
      restart = pile.restart;
      fmt::print("pile: {}\n",
                 pile.cached ? "cached" : fmt::format("settled in {:.0f} s", pile.wall_s));
    }
    std::fflush(stdout);
    sides::SidesSetup setup;
    setup.run_id = folder_.root.filename().string();
    setup.case_hash = cases::case_hash(case_);
    setup.ranks = case_.dem.ranks;
    setup.timeout_s = case_.coupling.timeout_s;
    setup.logs = folder_.logs();
    setup.checkpoints = folder_.checkpoints();
    setup.dem_screen = folder_.logs() / "dem.screen";
    if (from_) setup.leg = fmt::format("-{}", from_->step_index);
    setup.message_log = folder_.root / ("events" + setup.leg + ".lcmlog");
    setup.dem = sides::dem_settings(case_, shovel_, folder_.deck(), folder_.dumps(), folder_.logs(),
                                    restart, from_ ? std::optional(from_->memory) : std::nullopt);
    setup.mbs = sides::mbs_settings(case_, layers_);
    sides_ = std::make_unique<sides::Sides>(setup);
    rock_ = std::make_unique<TimedRock>(sides_->rock());
    record_ = std::make_unique<RunRecord>(
        folder_.record(), sides_->machine().info(), rock_->info(),
        std::map<std::string, std::string>{{"case", case_.text},
                                           {"case_folder", case_.folder.string()},
                                           {"case_hash", setup.case_hash},
                                           {"version", version()},
                                           {"machine_version", sides_->machine().info().version},
                                           {"rock_version", rock_->info().version}},
        from_ ? from_->record_rows : 0);
  }

  void drive() {
    const core::ServerInfo rock_info = rock_->info();
    particles_ = core::channel_index(rock_info, "particles");
    rocks_ = core::channel_index(rock_info, "rocks");
    core::Coupling coupling(sides_->machine(), *rock_, core::scheme_from(case_.coupling.scheme));
    if (from_) {
      sides_->machine().load(from_->machine());
      rock_->place(from_->X_WB_wall);
      coupling.resume(from_->step_index, from_->dem_step, from_->held, from_->X_WB_wall);
      record_->resume_at(time_s(), from_->rock_work_J, from_->machine_work_J);
      walls_ = from_->X_WB_wall;
      memory_ = from_->memory;
      sides_->machine().resume_at(from_->step_index, nanoseconds());
      sides_->rock().resume_at(from_->step_index, from_->dem_step);
    } else {
      const core::Window first = coupling.start();
      take(first);
      if (case_.pile.clear_machine == "on") {
        const auto channel = [&](const char* name) {
          return first.rock.channels[core::channel_index(rock_info, name)];
        };
        fmt::print("start: {:.0f} rocks, {:.2f} t, stood where the machine is and were removed\n",
                   channel("rocks_removed"), channel("mass_removed") * 1e-3);
      }
    }
    const auto payload = core::channel_index(rock_info, "mass_in_dipper");
    Progress progress(time_s(), static_cast<double>(end_step_) * case_.dem.timestep_s);
    auto flushed = Clock::now();
    double checkpoint_s = time_s();
    const auto began = Clock::now();
    while (dem_step_ < end_step_) {
      if (launch::interrupts() > 0) {
        checkpoint(coupling);
        progress.done();
        throw launch::Interrupted();
      }
      const core::Window w = coupling.advance(
          std::min<std::int64_t>(case_.coupling.sync_steps, end_step_ - dem_step_));
      take(w);
      facts_.wall_s = seconds_since(began);
      facts_.rock_wait_s = rock_->wait_s();
      progress.show(time_s(), w.rock.channels[payload]);
      if (seconds_since(flushed) > 1.0) {
        record_->flush();
        flushed = Clock::now();
      }
      if (case_.output.checkpoint_every_s > 0 &&
          time_s() >= checkpoint_s + case_.output.checkpoint_every_s - 1e-9) {
        checkpoint(coupling);
        checkpoint_s = time_s();
      }
    }
    progress.done();
    checkpoint(coupling);
    facts_.state_hash = state_hash();
    facts_.status = "complete";
  }

  std::int64_t nanoseconds() const { return dem_step_ * std::llround(case_.dem.timestep_s * 1e9); }

  void take(const core::Window& w) {
    record_->put(w);
    dem_step_ = w.rock.step;
    facts_.syncs = w.step_index;
    facts_.dem_steps = w.rock.step;
    facts_.particles = std::llround(w.rock.channels[particles_]);
    facts_.bodies = std::llround(w.rock.channels[rocks_]);
    walls_.clear();
    memory_.clear();
    for (std::size_t b = 0; b < w.rock.bodies.size(); ++b) {
      walls_.push_back(w.rock.bodies[b].X_WB);
      memory_.push_back({w.rock.bodies[b].end, w.V_WB_wall[b]});
    }
  }

  void checkpoint(const core::Coupling& coupling) {
    record_->flush();
    Checkpoint c;
    c.step_index = facts_.syncs;
    c.dem_step = dem_step_;
    c.held = coupling.held();
    c.X_WB_wall = walls_;
    c.memory = memory_;
    c.record_rows = record_->rows();
    c.rock_work_J = record_->interface_work_J();
    c.machine_work_J = record_->machine_work_J();
    c.dem_cpu_s = facts_.dem_cpu_s;
    c.mbs_cpu_s = facts_.mbs_cpu_s;
    save_checkpoint(folder_.checkpoints(), c, *rock_, sides_->machine());
    index_dumps(folder_.dumps(), case_.dem.timestep_s);
  }

  /// Rock and machine together.
  std::string state_hash() {
    const auto last = last_checkpoint(folder_.checkpoints());
    return sha256(rock_->state_hash() + sha256_file(last->machine()));
  }

  Outcome finish() {
    if (sides_) {
      if (facts_.status != "failed") sides_->stop();
      facts_.resends = sides_->machine_link().resends + sides_->rock_link().resends;
      facts_.foreign_messages = sides_->machine_link().foreign + sides_->rock_link().foreign;
      sides_->end();
      facts_.dem_cpu_s += sides_->dem_cpu_s();
      facts_.mbs_cpu_s += sides_->mbs_cpu_s();
    }
    if (record_) {
      index_dumps(folder_.dumps(), case_.dem.timestep_s);
      facts_.interface_work_J = record_->interface_work_J();
      facts_.energy_residual_J = record_->energy_residual_J();
      try {
        record_->flush();
        record_.reset();
        write_summary();
        write_observed(folder_.record(), case_.observation, folder_.root / "observed");
      } catch (const std::exception& e) {
        facts_.failure += fmt::format("{}{}", facts_.failure.empty() ? "" : "; ", e.what());
        facts_.status = "failed";
      }
    }
    return report();
  }

  void write_summary() {
    auto summary = summarise(facts_, folder_.record());
    if (case_.pile.clear_machine == "on") {
      const auto first = [&](const char* name) {
        return record::read_channel(folder_.record(), name).at(0);
      };
      summary["start"] = {{"rocks_removed", first("rock/rocks_removed")},
                          {"mass_removed_kg", first("rock/mass_removed")}};
    }
    const auto grading = achieved_grading(case_, folder_.dumps());
    std::ofstream(folder_.deck() / "achieved.csv") << to_csv(grading);
    for (const AchievedClass& k : grading)
      summary["rock"].push_back({{"class", k.name},
                                 {"rocks", k.rocks},
                                 {"mass_percent", k.mass_percent},
                                 {"wanted_percent", k.wanted_percent}});
    if (!case_.pile.profile.empty())
      if (const auto p = achieved_profile(case_, folder_.dumps())) {
        summary["pile"] = {{"below_profile_mean_m", p->below_mean_m},
                           {"below_profile_most_m", p->below_most_m},
                           {"below_profile_most_x_m", p->below_most_x_m},
                           {"face_deg", p->face_deg}};
        fmt::print(
            "pile: stood {:.2f} m below its profile in the mean, {:.2f} m at x = {:.1f} m; its "
            "face "
            "at {:.0f} deg\n",
            p->below_mean_m, p->below_most_m, p->below_most_x_m, p->face_deg);
      }
    std::ofstream out(folder_.summary());
    out << summary.dump(2) << '\n';
    if (!out.flush()) throw std::runtime_error("cannot write " + folder_.summary().string());
    for (const auto& p : summary.at("passes")) {
      fmt::print(
          "pass {}: payload {:.1f} t, truck {:.1f} t, dig force mean {:.0f} kN, peak {:.0f} kN\n",
          p.at("pass").get<int>(), p.at("payload_kg").get<double>() * 1e-3,
          p.at("truck_kg").get<double>() * 1e-3, p.at("dig_force_mean_N").get<double>() * 1e-3,
          p.at("dig_force_peak_N").get<double>() * 1e-3);
    }
  }

  Outcome report() {
    const auto last = last_checkpoint(folder_.checkpoints());
    const std::string resume =
        last ? fmt::format("last checkpoint: {} (t = {:.3f} s); `dipper run {} --out {} --resume`",
                           last->folder.string(),
                           static_cast<double>(last->dem_step) * case_.dem.timestep_s,
                           case_.folder.string(), folder_.root.string())
             : "no checkpoint yet";
    if (facts_.status == "failed") {
      fmt::print(stderr, "dipper: {}\ndipper: {}\n", facts_.failure, resume);
      return Outcome::failed;
    }
    if (facts_.status == "interrupted") {
      fmt::print(stderr, "dipper: interrupted at t = {:.3f} s; {}\n", time_s(), resume);
      return Outcome::interrupted;
    }
    fmt::print("{}\n", folder_.summary().string());
    return Outcome::complete;
  }

  const cases::Case& case_;
  RunFolder folder_;
  std::optional<Checkpoint> from_;
  sides::MeshFacts shovel_;
  sides::DipperLayers layers_;
  std::int64_t end_step_ = 0, dem_step_ = 0;
  RunFacts facts_;
  std::size_t particles_ = 0, rocks_ = 0;  // the rock's channels of these names
  std::unique_ptr<sides::Sides> sides_;
  std::unique_ptr<TimedRock> rock_;
  std::unique_ptr<RunRecord> record_;
  std::vector<Pose> walls_;
  std::vector<dem::WallMemory> memory_;
};

}  // namespace

std::vector<std::string> changed_since(const fs::path& folder, const cases::Case& c) {
  const auto keys = [](const CaseLines& lines) {
    std::set<std::string> kept;
    for (const CaseLine& line : lines) {
      const bool free =
          line.key == "end_s" || is_within(line.key, "output") || line.key == "coupling.timeout_s";
      if (!free) kept.insert(line.key + '=' + line.value);
    }
    return kept;
  };
  const auto before = keys(CaseLines::read(folder / "case.txt")), now = keys(CaseLines(c.text));
  std::vector<std::string> changed;
  std::set_symmetric_difference(before.begin(), before.end(), now.begin(), now.end(),
                                std::back_inserter(changed));
  return changed;
}

Outcome paired_run(const cases::Case& c, const RunOptions& options) {
  return Leg(c, options).run();
}

}  // namespace dipper::run
