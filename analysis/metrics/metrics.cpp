#include "analysis/metrics/metrics.hpp"

#include <algorithm>

#include "analysis/metrics/metric_tables.hpp"
#include "analysis/rock/load.hpp"

namespace dipper::analysis::metrics {
namespace {

constexpr double kLoadCell_m = 0.05;

/// The last frame at or before a time.
std::size_t frame_before(const io::DumpFolder& dumps, double t) {
  const auto after = std::upper_bound(dumps.time_s.begin(), dumps.time_s.end(), t + 1e-9);
  return after == dumps.time_s.begin() ? 0
                                       : static_cast<std::size_t>(after - dumps.time_s.begin()) - 1;
}

std::vector<PassFacts> find_facts(const run::RunData& run, const io::DumpFolder& dumps) {
  std::vector<PassFacts> facts;
  if (!run.is_run) return facts;
  for (const signals::PassPhases& p :
       signals::find_pass_phases(run.signals.pass, run.signals.drive)) {
    PassFacts f;
    static_cast<signals::PassPhases&>(f) = p;
    const signals::Phase* swing = f.phase("swing");
    f.load.start_frame = frame_before(dumps, f.pass.t_start_s);
    f.load.lift_frame = frame_before(dumps, swing != nullptr ? swing->t_start_s : f.pass.t_dump_s);
    f.load.end_frame = std::max(frame_before(dumps, f.t_end_s), f.load.lift_frame);
    facts.push_back(f);
  }
  return facts;
}

void add_load(PassFacts& f, const run::RunData& run, const io::DumpFolder& dumps,
              const Survey& survey) {
  const std::size_t k = frame_before(dumps, f.pass.t_dump_s);
  const Pose X_WB = run.dipper.at(dumps.time_s[k]).X_WB;
  const auto balls = balls_in(dumps.frames[k], *run.regions.dipper, X_WB);
  const Vector3d up_B = X_WB.R.conjugate() * Vector3d::UnitZ();
  f.load_volume_m3 = rock::load_volume(balls, up_B, *run.regions.dipper, kLoadCell_m);
  f.load_in_volume_kg = survey.frames[k].in_dipper_kg;
}

void add_stages(PassFacts& f, const run::RunData& run, const io::DumpFolder& dumps,
                const Survey& survey) {
  const signals::Phase* breakout = f.phase("breakout");
  const double leave_s = breakout != nullptr ? breakout->t_start_s : f.pass.t_dump_s;
  const auto leave = static_cast<std::size_t>(
      std::lower_bound(dumps.time_s.begin(), dumps.time_s.end(), leave_s) - dumps.time_s.begin());
  const double depth = run.regions.lip_x_m - run.regions.dipper->min_m.x();
  f.stages =
      rock::find_stages(survey.frames, f.load.start_frame, f.load.lift_frame + 1, leave, depth);
}

json dipper_table(const run::RunData& run, const rock::StruckVolume& struck) {
  json out = {{"struck_volume_m3", struck.volume_m3},
              {"strike_normal_B", {struck.up.x(), struck.up.y(), struck.up.z()}}};
  if (run.struck_given_m3 > 0) out["struck_volume_given_m3"] = run.struck_given_m3;
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
  std::vector<PassFacts> passes = find_facts(run, dumps);
  std::vector<LoadToFollow> loads;
  for (const PassFacts& f : passes) loads.push_back(f.load);
  const Survey survey = survey_frames(dumps, run.clumps, run.regions, run.dipper, loads);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const LoadToFollow& load = passes[k].load;
    const bool lifted = dumps.time_s[load.lift_frame] >= passes[k].pass.t_dig_s;
    if (lifted &&
        (!passes[k].pass.dumped || dumps.time_s[load.end_frame] > passes[k].pass.t_dump_s))
      passes[k].fate = survey.fates[k];
    passes[k].still = static_weight(run.signals, passes[k].pass);
    if (!run.regions.dipper) continue;
    if (passes[k].still)
      passes[k].suspended = suspended_load(dumps, run.clumps, run.regions, run.dipper,
                                           passes[k].still->from_s, passes[k].still->to_s);
    if (lifted) add_load(passes[k], run, dumps, survey);
    add_stages(passes[k], run, dumps, survey);
  }
  const auto surface = [&](std::size_t k) {
    const Pose X_WB = run.dipper.empty() ? Pose{} : run.dipper.at(dumps.time_s[k]).X_WB;
    return pile_surface(dumps.frames[k], run.regions, X_WB, survey.pile, 0);
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
  for (const char* key : {"coupling", "dem", "mbs"})
    if (run.summary.is_object() && run.summary.contains(key)) v[key] = run.summary[key];
  if (run.regions.dipper && struck.volume_m3 > 0) v["dipper"] = dipper_table(run, struck);
  if (run.is_run) {
    v["passes"] = passes_table(run, passes, struck.volume_m3);
    v["phases"] = phases_table(run, passes);
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
