#include "coupler/result/pass_rows.hpp"

#include <fmt/format.h>

#include "analysis/metrics/pass_rows.hpp"
#include "common/angles.hpp"
#include "common/fines.hpp"
#include "common/input_error.hpp"
#include "common/record/record.hpp"
#include "coupler/deck/contact_table.hpp"
#include "coupler/sides/sides_setup.hpp"

namespace dipper::result {

using json = nlohmann::ordered_json;

namespace {

namespace fs = std::filesystem;
namespace metrics = analysis::metrics;

/// The dumps; empty when there are none, or when they are damaged, which the report says.
std::optional<analysis::io::DumpFolder> dumps_of(const RunFolder& folder, double timestep_s) {
  try {
    return analysis::io::open_dump_folder(folder.root(), timestep_s);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

metrics::PassFigureMaker::Known known_of(const cases::Case& c, double struck_volume_m3) {
  metrics::PassFigureMaker::Known known;
  known.machine = machine::load_machine(c.machine.model);
  known.rake_rad = radians(c.machine.rake_angle_deg);
  known.limited_drives = c.machine.drives == machine::DriveMode::limited;
  known.struck_volume_m3 = struck_volume_m3;
  known.bulk_density_kg_m3 =
      with_fines(c.rock.bulk_density_kg_m3, c.rock.fines_fraction, deck::porosity(c));
  return known;
}

}  // namespace

json pass_rows(const cases::Case& c, const RunFolder& folder) {
  if (c.machine.kind != cases::MachineKind::shovel) return json::array();
  const fs::path record = folder.record();
  if (record::read_channel(record, "time_s").size() < 2) return json::array();
  const analysis::run::RunSignals signals = analysis::run::read_signals(record);
  const cases::DipperFacts dipper = sides::read_mesh_facts(c).dipper;
  const metrics::PassFigureMaker maker(signals, record, known_of(c, dipper.struck_volume_m3));
  analysis::rock::LoadRegions regions;
  regions.dipper = dipper.load;
  const auto dumps = dumps_of(folder, c.dem.timestep_s);
  const auto clumps = analysis::rock::read_clump_masses(folder.deck() / "rocks.in");
  const auto load = [&](const analysis::signals::PassPhases& pass) {
    std::optional<metrics::LoadInDipper> found;
    if (!dumps) return found;
    try {
      found = metrics::load_in_dipper(*dumps, clumps, regions, signals.walls.at("dipper"), pass);
    } catch (const InputError&) {  // a damaged dump; the report says so
    }
    return found;
  };
  std::vector<metrics::PassFigures> passes;
  for (const auto& pass : analysis::signals::find_pass_phases(signals.pass, signals.drive))
    passes.push_back(maker.figures(pass, load(pass)));
  return metrics::nested_rows(passes);
}

void report_passes(const json& passes, Reporter& reporter) {
  for (const auto& p : passes) {
    const auto in = [&p](const char* key, double unit) { return p.at(key).get<double>() / unit; };
    reporter.line(fmt::format(
        "pass {}: {}payload {:.1f} t, truck {:.1f} t, dig force: mean {:.0f} kN to the dump{}, "
        "peak {:.0f} kN",
        p.at("pass").get<int>(), p.at("dumped").get<bool>() ? "" : "unfinished; ",
        in("payload_kg", 1e3), in("truck_kg", 1e3), in("dig_force_mean_N", 1e3),
        p.contains("dig_phases_force_mean_N")
            ? fmt::format(", {:.0f} kN over the dig", in("dig_phases_force_mean_N", 1e3))
            : "",
        in("dig_force_peak_N", 1e3)));
  }
}

}  // namespace dipper::result
