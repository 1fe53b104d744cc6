#include "coupler/result/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/json_text.hpp"
#include "common/record/record.hpp"
#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/case/schema.hpp"
#include "coupler/result/achieved_grading.hpp"
#include "coupler/result/achieved_profile.hpp"
#include "coupler/result/drive_limits_met.hpp"
#include "coupler/result/operator_summary.hpp"
#include "coupler/result/pass_rows.hpp"
#include "coupler/result/run_warnings.hpp"
#include "coupler/result/truck_load.hpp"

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

json summarise(const cases::Case& c, const RunFacts& f, const RunFolder& folder) {
  const std::filesystem::path record = folder.record();
  const auto time_s = record::read_channel(record, "time_s");
  const double sim_s = time_s.empty() ? 0.0 : time_s.back();
  const double cpu_s = f.cost.dem_cpu_s + f.cost.mbs_cpu_s;
  const auto ratio = [](double a, double b) { return b > 0 ? a / b : 0.0; };
  // As at the end, also when this segment took no window.
  const auto last = [&](const char* channel) {
    const auto rows = record::read_channel(record, channel);
    return static_cast<std::int64_t>(rows.empty() ? 0 : std::llround(rows.back()));
  };
  const std::int64_t particles = last("rock/particles");
  json out = {
      {"case", c.name},
      {"seed", c.seed},
      {"version", version()},
      {"status", f.status},
      {"effects", c.effects},
      {"passes", pass_rows(c, folder)},
      {"coupling",
       {{"scheme", cases::word_of(c, "coupling.scheme")},
        {"syncs", f.syncs},
        {"sync_step_mean_s", ratio(sim_s, static_cast<double>(f.syncs))},
        {"overhead_fraction", ratio(f.cost.wall_s - f.cost.rock_busy_s, f.cost.wall_s)},
        {"energy_residual_J", f.energy_residual_J},
        {"interface_work_J", f.interface_work_J},
        {"resends", f.cost.resends},
        {"foreign_messages", f.cost.foreign_messages}}},
      {"dem",
       {{"particles", particles},
        {"bodies", last("rock/rocks")},
        {"timestep_s", c.dem.timestep_s},
        {"steps", f.dem_steps},
        {"cpu_s", f.cost.dem_cpu_s},
        {"wall_s", f.cost.wall_s},
        {"particle_steps_per_cpu_s",
         ratio(static_cast<double>(particles) * static_cast<double>(f.dem_steps),
               f.cost.dem_cpu_s)}}},
      {"mbs", {{"cpu_s", f.cost.mbs_cpu_s}, {"realtime_factor", ratio(sim_s, f.cost.mbs_cpu_s)}}},
      {"sim_s", sim_s},
      {"cpu_s_per_sim_s", ratio(cpu_s, sim_s)},
      {"state_hash", f.state_hash}};
  if (!f.operator_command.empty()) out["operator"] = f.operator_command;
  if (!f.failure.empty()) out["failure"] = f.failure;
  return out;
}

json achieved(const cases::Case& c, const RunFolder& folder) {
  json rock = json::array();
  const auto grading = achieved_grading(c, folder.dumps());
  write_text(folder.deck() / "achieved.csv", to_csv(grading));
  for (const AchievedClass& k : grading) {
    rock.push_back({{"class", k.name},
                    {"rocks", k.rocks},
                    {"mass_percent", k.mass_percent},
                    {"wanted_percent", k.wanted_percent}});
  }
  return rock;
}

/// What has left the domain, in kg. Rock that comes down from above adds to the mass, and rock that
/// is cleared away on a return without contact is taken out of it.
double rock_lost(const cases::Case& c, const RunFolder& folder) {
  std::vector<double> mass = record::read_channel(folder.record(), "rock/rock_mass");
  if (!c.machine.contact_on_return)
    for (const char* cleared : {"rock/cleared_overlap", "rock/cleared_floor"}) {
      const std::vector<double> kg = record::read_channel(folder.record(), cleared);
      for (std::size_t i = 0; i < mass.size(); ++i) mass[i] += kg.at(i);
    }
  double lost = 0;
  for (std::size_t i = 1; i < mass.size(); ++i) lost += std::max(0.0, mass[i - 1] - mass[i]);
  return lost;
}

json describe(const AchievedProfile& p) {
  json out = {{"below_profile_mean_m", p.below_mean_m},
              {"below_profile_most_m", p.below_most_m},
              {"below_profile_most_x_m", p.below_most_x_m}};
  if (p.face_deg) out["face_deg"] = *p.face_deg;
  return out;
}

}  // namespace

void write_summary(const cases::Case& c, const RunFolder& folder, const RunFacts& facts,
                   Reporter& reporter) {
  json summary = summarise(c, facts, folder);
  if (c.pile.clear_machine && facts.syncs > 0) {
    const auto first = [&](const char* name) {
      return record::read_channel(folder.record(), name).at(0);
    };
    summary["start"] = {{"rocks_removed", first("rock/rocks_removed")},
                        {"mass_removed_kg", first("rock/mass_removed")}};
  }
  if (facts.syncs > 0) summary["dem"]["rock_lost_kg"] = rock_lost(c, folder);
  summary["rock"] = achieved(c, folder);
  const auto profile = c.pile.profile.empty() ? std::nullopt : achieved_profile(c, folder.dumps());
  if (profile) {
    summary["pile"] = describe(*profile);
    reporter.line(fmt::format(
        "pile: {:.2f} m below its profile on average, {:.2f} m at x = {:.1f} m{}",
        profile->below_mean_m, profile->below_most_m, profile->below_most_x_m,
        profile->face_deg ? fmt::format("; its face at {:.0f} deg", *profile->face_deg) : ""));
  }
  report_drives(c, folder.record(), summary, reporter);
  if (const auto truck = truck_load(c.truck.rated_t, summary.at("passes"))) {
    summary["truck"] = as_json(*truck);
    reporter.line("truck: " + to_text(*truck));
  }
  if (json planned = operator_summary(c, folder); !planned.is_null()) summary["operator"] = planned;
  const std::vector<std::string> warnings = run_warnings(c, summary);
  summary["warnings"] = warnings;
  write_text(folder.summary(), summary.dump(2) + '\n');
  report_passes(summary.at("passes"), reporter);
  for (const std::string& warning : warnings) reporter.line("warning: " + warning);
}

std::string summary_status(const std::filesystem::path& summary) {
  const nlohmann::json j = read_json_or_discard(summary);
  return j.is_object() ? j.value("status", "") : "";
}

}  // namespace dipper::result
