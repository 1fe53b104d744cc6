#include "coupler/run/summary.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "analysis/run/run_folder.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "common/record/record.hpp"
#include "common/version.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/run/achieved_grading.hpp"
#include "coupler/run/achieved_profile.hpp"
#include "coupler/run/drive_limits_met.hpp"
#include "coupler/run/run_warnings.hpp"
#include "coupler/run/teeth_deviation.hpp"
#include "coupler/sides/sides_setup.hpp"

namespace dipper::run {
namespace {

using json = nlohmann::ordered_json;

json summarise(const cases::Case& c, const RunFacts& f, const std::filesystem::path& record) {
  const double full_kg = c.rock.bulk_density_kg_m3 * deck::laden_density(c) / c.rock.density_kg_m3 *
                         sides::read_mesh_facts(c).dipper.struck_volume_m3;
  const analysis::run::RunSignals signals = analysis::run::read_drive_signals(record);
  json passes = json::array();
  const TeethDeviation teeth(record, c);
  for (const auto& found : analysis::signals::find_pass_phases(signals.pass, signals.drive)) {
    const auto& p = found.pass;
    json row = {{"pass", p.pass},
                {"t_start_s", p.t_start_s},
                {"t_dig_s", p.t_dig_s},
                {"t_dump_s", p.t_dump_s},
                {"t_end_s", p.t_end_s},
                {"payload_kg", p.payload_kg},
                {"truck_kg", p.truck_kg},
                {"fill_factor", p.payload_kg / full_kg},
                {"dig_force_mean_N", p.dig_force_mean_N},
                {"dig_force_peak_N", p.dig_force_peak_N},
                {"dig_force_peak_t_s", p.dig_force_peak_t_s}};
    if (found.dig_phases_force_mean_N)
      row["dig_phases_force_mean_N"] = *found.dig_phases_force_mean_N;
    if (found.dig_slack_share) row["dig_slack_share"] = *found.dig_slack_share;
    if (const auto dig = found.dig()) row["teeth_deviation_m"] = teeth.most(*dig);
    passes.push_back(row);
  }
  const double sim_s = signals.pass.time_s.empty() ? 0.0 : signals.pass.time_s.back();
  const double cpu_s = f.cost.dem_cpu_s + f.cost.mbs_cpu_s;
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  json out = {
      {"case", c.name},
      {"seed", c.seed},
      {"version", version()},
      {"status", f.status},
      {"effects", c.effects},
      {"passes", passes},
      {"coupling",
       {{"scheme", c.coupling.scheme},
        {"syncs", f.syncs},
        {"sync_step_mean_s", ratio(sim_s, static_cast<double>(f.syncs))},
        {"overhead_fraction", ratio(f.cost.wall_s - f.cost.rock_wait_s, f.cost.wall_s)},
        {"energy_residual_J", f.energy_residual_J},
        {"interface_work_J", f.interface_work_J},
        {"resends", f.resends},
        {"foreign_messages", f.foreign_messages}}},
      {"dem",
       {{"particles", f.particles},
        {"bodies", f.bodies},
        {"timestep_s", c.dem.timestep_s},
        {"steps", f.dem_steps},
        {"cpu_s", f.cost.dem_cpu_s},
        {"wall_s", f.cost.wall_s},
        {"particle_steps_per_cpu_s",
         ratio(static_cast<double>(f.particles) * static_cast<double>(f.dem_steps),
               f.cost.dem_cpu_s)}}},
      {"mbs", {{"cpu_s", f.cost.mbs_cpu_s}, {"realtime_factor", ratio(sim_s, f.cost.mbs_cpu_s)}}},
      {"sim_s", sim_s},
      {"cpu_s_per_sim_s", ratio(cpu_s, sim_s)},
      {"state_hash", f.state_hash}};
  if (!f.failure.empty()) out["failure"] = f.failure;
  return out;
}

json achieved(const cases::Case& c, const RunFolder& folder) {
  json rock = json::array();
  const auto grading = achieved_grading(c, folder.dumps());
  std::ofstream(folder.deck() / "achieved.csv") << to_csv(grading);
  for (const AchievedClass& k : grading) {
    rock.push_back({{"class", k.name},
                    {"rocks", k.rocks},
                    {"mass_percent", k.mass_percent},
                    {"wanted_percent", k.wanted_percent}});
  }
  return rock;
}

json describe(const DriveLimitsMet& d) {
  return {{"path_time_s", d.path_time_s},
          {"late_s", d.late_s},
          {"hoist_saturated_s", d.hoist_saturated_s},
          {"crowd_saturated_s", d.crowd_saturated_s},
          {"swing_saturated_s", d.swing_saturated_s},
          {"ropes_slack_s", d.ropes_slack_s},
          {"crowd_relief_most_m", d.crowd_relief_most_m}};
}

void tell_drives(const DriveLimitsMet& d, Reporter& reporter) {
  reporter.line(fmt::format(
      "drives: {:.1f} s late; at their limit for {:.1f} s (hoist), {:.1f} s (crowd), {:.1f} s "
      "(swing); the crowd let back by {:.2f} m at most",
      d.late_s, d.hoist_saturated_s, d.crowd_saturated_s, d.swing_saturated_s,
      d.crowd_relief_most_m));
}

json describe(const AchievedProfile& p) {
  return {{"below_profile_mean_m", p.below_mean_m},
          {"below_profile_most_m", p.below_most_m},
          {"below_profile_most_x_m", p.below_most_x_m},
          {"face_deg", p.face_deg}};
}

void tell_passes(const json& passes, Reporter& reporter) {
  for (const auto& p : passes) {
    reporter.line(fmt::format(
        "pass {}: payload {:.1f} t, truck {:.1f} t, dig force mean {:.0f} kN, peak {:.0f} kN",
        p.at("pass").get<int>(), p.at("payload_kg").get<double>() * 1e-3,
        p.at("truck_kg").get<double>() * 1e-3, p.at("dig_force_mean_N").get<double>() * 1e-3,
        p.at("dig_force_peak_N").get<double>() * 1e-3));
  }
}

}  // namespace

void write_summary(const cases::Case& c, const RunFolder& folder, const RunFacts& facts,
                   Reporter& reporter) {
  json summary = summarise(c, facts, folder.record());
  if (c.pile.clear_machine == "on") {
    const auto first = [&](const char* name) {
      return record::read_channel(folder.record(), name).at(0);
    };
    summary["start"] = {{"rocks_removed", first("rock/rocks_removed")},
                        {"mass_removed_kg", first("rock/mass_removed")}};
  }
  summary["rock"] = achieved(c, folder);
  const auto profile = c.pile.profile.empty() ? std::nullopt : achieved_profile(c, folder.dumps());
  if (profile) {
    summary["pile"] = describe(*profile);
    reporter.line(fmt::format(
        "pile: stood {:.2f} m below its profile in the mean, {:.2f} m at x = {:.1f} m; its face at "
        "{:.0f} deg",
        profile->below_mean_m, profile->below_most_m, profile->below_most_x_m, profile->face_deg));
  }
  if (c.machine.drives == "limited") {
    const DriveLimitsMet met = drive_limits_met(folder.record());
    summary["drives"] = describe(met);
    tell_drives(met, reporter);
  }
  const std::vector<std::string> warnings = run_warnings(c, summary);
  summary["warnings"] = warnings;
  std::ofstream out(folder.summary());
  out << summary.dump(2) << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + folder.summary().string());
  tell_passes(summary.at("passes"), reporter);
  for (const std::string& warning : warnings) reporter.line("warning: " + warning);
}

std::string summary_status(const std::filesystem::path& summary) {
  std::ifstream in(summary);
  const json j = json::parse(in, nullptr, false);
  return j.is_object() ? j.value("status", "") : "";
}

}  // namespace dipper::run
