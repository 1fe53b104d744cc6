#include "coupler/run/pass_rows.hpp"

#include <fmt/format.h>

#include "analysis/run/pass_figures.hpp"
#include "analysis/signals/pass_phases.hpp"
#include "common/angles.hpp"
#include "common/record/record.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/run/rattle.hpp"
#include "coupler/sides/sides_setup.hpp"

namespace dipper::run {

using json = nlohmann::ordered_json;

namespace {

constexpr double kJump = 0.3;  // of the dig's mean force, from one step to the next

}  // namespace

json pass_rows(const cases::Case& c, const std::filesystem::path& record) {
  const double full_kg = c.rock.bulk_density_kg_m3 * deck::laden_density(c) / c.rock.density_kg_m3 *
                         sides::read_mesh_facts(c).dipper.struck_volume_m3;
  const analysis::run::RunSignals signals = analysis::run::read_drive_signals(record);
  json passes = json::array();
  const Rattle rattle(record);
  const machine::MachineData machine = machine::load_machine(c.machine.model);
  const double rake = radians(c.machine.rake_angle_deg);
  const analysis::signals::PayloadMonitor monitor(machine, rake);
  const analysis::signals::MachineDemand demand(
      machine, rake, record::read_channel(record, "machine/saddle_pitch"));
  for (const auto& found : analysis::signals::find_pass_phases(signals.pass, signals.drive)) {
    const auto& p = found.pass;
    json row = analysis::run::pass_row(p);
    row["fill_factor"] = p.payload_kg / full_kg;
    row["dig_force_mean_N"] = p.dig_force_mean_N;
    row["dig_force_peak_N"] = p.dig_force_peak_N;
    row["dig_force_peak_t_s"] = p.dig_force_peak_t_s;
    if (found.dig_phases_force_mean_N)
      row["dig_phases_force_mean_N"] = *found.dig_phases_force_mean_N;
    if (found.dig_slack_share) row["dig_slack_share"] = *found.dig_slack_share;
    if (const auto dig = found.dig()) {
      analysis::run::put_demand(row, demand.over(signals.drive, dig->t_start_s, dig->t_end_s));
      row["dig_rattle_share"] = rattle.share(*dig, kJump * p.dig_force_mean_N);
    }
    analysis::run::put_dig_energy(row, signals, found);
    analysis::run::put_monitor(row, signals, found, monitor);
    json& phases = row["phases"] = json::array();
    for (const auto& phase : found.phases) {
      json one = {{"phase", phase.name},
                  {"t_start_s", phase.t_start_s},
                  {"t_end_s", phase.t_end_s},
                  {"slack_share",
                   analysis::signals::slack_share(signals.pass, phase.t_start_s, phase.t_end_s)}};
      analysis::run::put_demand(one, demand.over(signals.drive, phase.t_start_s, phase.t_end_s));
      analysis::run::put_work(
          one, analysis::signals::drives_work(signals.drive, phase.t_start_s, phase.t_end_s));
      phases.push_back(one);
    }
    passes.push_back(row);
  }
  return passes;
}

void tell_passes(const json& passes, Reporter& reporter) {
  for (const auto& p : passes) {
    const auto dig = p.find("dig_phases_force_mean_N");
    reporter.line(fmt::format(
        "pass {}: {}payload {:.1f} t, truck {:.1f} t, dig force mean {:.0f} kN, peak {:.0f} kN{}",
        p.at("pass").get<int>(), p.at("dumped").get<bool>() ? "" : "unfinished; ",
        p.at("payload_kg").get<double>() * 1e-3, p.at("truck_kg").get<double>() * 1e-3,
        p.at("dig_force_mean_N").get<double>() * 1e-3,
        p.at("dig_force_peak_N").get<double>() * 1e-3,
        dig == p.end()
            ? ""
            : fmt::format("; {:.0f} kN from penetrate to breakout", dig->get<double>() * 1e-3)));
  }
}

}  // namespace dipper::run
