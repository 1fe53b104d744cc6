#include "analysis/metrics/metrics.hpp"

#include <algorithm>

#include "analysis/metrics/metric_tables.hpp"
#include "analysis/metrics/pass_rows.hpp"
#include "analysis/rock/struck_volume.hpp"
#include "analysis/run/figure.hpp"
#include "common/angles.hpp"

namespace dipper::analysis::metrics {
namespace {

/// The input for the figures of a run's passes, from run and case.
PassFigureMaker::Known known_of(const run::RunData& run, const rock::StruckVolume& struck) {
  PassFigureMaker::Known known;
  if (const auto file = run.folder / run::kMachineFile; std::filesystem::exists(file)) {
    known.machine = machine::load_machine(file);
    known.rake_rad = radians(run.number("machine.rake_angle_deg"));
  }
  known.limited_drives = run.text("machine.drives") == "limited";
  known.struck_volume_m3 = run.struck_given_m3 > 0 ? run.struck_given_m3 : struck.volume_m3;
  known.bulk_density_kg_m3 = run.bulk_density_kg_m3;
  return known;
}

std::vector<PassFacts> find_facts(const run::RunData& run, const io::DumpFolder& dumps,
                                  const rock::StruckVolume& struck) {
  std::vector<PassFacts> facts;
  if (!run.is_shovel) return facts;
  const PassFigureMaker maker(run.signals, run.folder / "record.h5", known_of(run, struck));
  for (const signals::PassPhases& p :
       signals::find_pass_phases(run.signals.pass, run.signals.drive)) {
    PassFacts f;
    static_cast<PassFigures&>(f) =
        maker.figures(p, load_in_dipper(dumps, run.clumps, run.regions, run.dipper, p));
    f.followed.start_frame = frame_before(dumps, p.pass.t_start_s);
    f.followed.lift_frame = lift_frame(dumps, p);
    f.followed.end_frame = std::max(frame_before(dumps, p.t_end_s), f.followed.lift_frame);
    facts.push_back(std::move(f));
  }
  return facts;
}

void add_stages(PassFacts& f, const run::RunData& run, const io::DumpFolder& dumps,
                const Survey& survey) {
  const signals::Phase* breakout = f.found.phase(signals::PhaseName::breakout);
  const double leave_s = breakout != nullptr ? breakout->t_start_s : f.found.pass.t_dump_s;
  const auto leave = static_cast<std::size_t>(
      std::lower_bound(dumps.time_s.begin(), dumps.time_s.end(), leave_s) - dumps.time_s.begin());
  const double depth = run.regions.lip_x_m - run.regions.dipper->min_m.x();
  // From first contact on: before it, what is inside stuck there in the pass before.
  const auto contact = static_cast<std::size_t>(
      std::lower_bound(dumps.time_s.begin(), dumps.time_s.end(), f.found.pass.t_dig_s) -
      dumps.time_s.begin());
  f.stages = rock::find_stages(survey.frames, std::max(contact, f.followed.start_frame),
                               f.followed.lift_frame + 1, leave, depth);
}

json dipper_table(const run::RunData& run, const rock::StruckVolume& struck) {
  json out = {{"struck_volume_m3", struck.volume_m3},
              {"strike_normal_B", {struck.up.x(), struck.up.y(), struck.up.z()}}};
  if (run.struck_given_m3 > 0) out["struck_volume_given_m3"] = run.struck_given_m3;
  if (const auto file = run.folder / run::kMachineFile; std::filesystem::exists(file)) {
    const machine::MachineData machine = machine::load_machine(file);
    out["machine"] = machine.machine;
    if (machine.dipper.rated_load > 0) {
      out["rated_load_kg"] = machine.dipper.rated_load;
      out["rated_load_assumed"] = machine.dipper.rated_load_assumed;
    }
  }
  const Box& r = *run.regions.dipper;
  out["cavity"] = {{"min_m", {r.min_m.x(), r.min_m.y(), r.min_m.z()}},
                   {"max_m", {run.regions.lip_x_m, r.max_m.y(), r.max_m.z()}}};
  return out;
}

}  // namespace

Metrics compute_metrics(run::RunData& run, const io::DumpFolder& dumps) {
  Metrics m;
  rock::StruckVolume struck;
  if (!run.vessel.triangles.empty()) {
    struck = rock::struck_volume(run.vessel);
    if (!run.regions.dipper && struck.volume_m3 > 0) {
      run.regions.dipper = Box{struck.water.min_m, struck.water.max_m};
      run.regions.lip_x_m = struck.water.max_m.x();
    }
  }
  std::vector<PassFacts> passes = find_facts(run, dumps, struck);
  std::vector<LoadToFollow> loads;
  for (const PassFacts& f : passes) loads.push_back(f.followed);
  const Survey survey = survey_frames(dumps, run.clumps, run.regions, run.dipper, loads);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const LoadToFollow& load = passes[k].followed;
    const bool lifted = dumps.time_s[load.lift_frame] >= passes[k].found.pass.t_dig_s;
    const signals::Pass& pass = passes[k].found.pass;
    if (lifted && (!pass.dumped || dumps.time_s[load.end_frame] > pass.t_dump_s))
      passes[k].fate = survey.fates[k];
    if (pass.dumped) passes[k].still = static_weight(run.signals, pass);
    if (!run.regions.dipper) continue;
    if (passes[k].still)
      passes[k].suspended = suspended_load(dumps, run.clumps, run.regions, run.dipper,
                                           passes[k].still->from_s, passes[k].still->to_s);
    if (dumps.has_velocities()) add_stages(passes[k], run, dumps, survey);
  }
  // The ground of a run is at 0; that of other dumps is under their lowest rock.
  const double floor_m = run.is_run ? 0 : lowest_m(dumps.frames.front(), survey.pile);
  const auto surface = [&](std::size_t k) {
    const Pose X_WB = run.dipper.empty() ? Pose{} : run.dipper.at(dumps.time_s[k]).X_WB;
    return pile_surface(dumps.frames[k], run.regions, X_WB, survey.pile, floor_m);
  };
  json& v = m.values;
  v["format"] = 1;
  v["source"] = {
      {"folder", run.folder.filename().empty() ? run.folder.parent_path().filename().string()
                                               : run.folder.filename().string()},
      {"kind", run.is_run ? "run" : "dumps"},
      {"particles", dumps.particles},
      {"frames", dumps.frames.size()},
      {"timestep_s", dumps.timestep_s},
      {"mass_from", rock::mass_source(dumps.frames.front(), run.clumps)}};
  v["run"] = run_table(run, dumps, survey);
  for (const char* key : {"coupling", "dem", "mbs", "drives"})
    if (run.summary.is_object() && run.summary.contains(key)) v[key] = run.summary[key];
  if (run.regions.dipper && struck.volume_m3 > 0) v["dipper"] = dipper_table(run, struck);
  if (run.is_shovel) {
    v["passes"] = passes_table(passes);
    v["phases"] = phase_table({passes.begin(), passes.end()});
    v["stages"] = stages_table(dumps, survey, passes);
  }
  v["frames"] = frames_table(dumps, survey, run.regions);
  const PileSurface before = surface(0);
  if (!before.profile.x_m.empty()) {
    std::optional<PileSurface> after;
    if (dumps.frames.size() > 1) after = surface(dumps.frames.size() - 1);
    v["pile"] = pile_table(before, after ? &*after : nullptr);
  }
  v["sizes"] = sizes_table(run, survey, passes);
  m.walls = rock::read_wall_fields(dumps);
  v["walls"] = walls_table(m.walls);
  return m;
}

}  // namespace dipper::analysis::metrics
