#include "coupler/cli/report_command.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "analysis/metrics/paraview_files.hpp"
#include "analysis/metrics/report_files.hpp"
#include "analysis/report/run_page.hpp"
#include "analysis/run/run_folder.hpp"
#include "common/input_error.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

analysis::run::RunFolder open_folder(const ReportWords& words) {
  if (fs::exists(fs::path(words.folder) / "record.h5")) {
    if (!words.mesh.empty())
      throw InputError({{words.folder, 0, "",
                         "has a record of its own; --mesh and --poses are for dumps of other "
                         "programs"}});
    return analysis::run::read_run_folder(words.folder);
  }
  if (words.mesh.empty() != words.poses.empty())
    throw InputError(
        {{{}, 0, "--mesh and --poses", "one tells nothing without the other; give both"}});
  std::optional<analysis::run::ForeignDipper> dipper;
  if (!words.mesh.empty()) dipper = analysis::run::ForeignDipper{words.mesh, words.poses};
  return analysis::run::read_foreign_folder(words.folder, dipper);
}

/// Told before the work is done, and to somebody who reads another one's run.
void refuse_unwritable(const fs::path& folder) {
  const fs::path parent = fs::absolute(folder).parent_path();
  if (fs::is_directory(parent) && access(parent.c_str(), W_OK | X_OK) == 0) return;
  throw InputError(
      {{parent, 0, "", "cannot be written into; say with --out where the report goes"}});
}

void print_passes(const nlohmann::ordered_json& metrics) {
  if (!metrics.contains("passes")) return;
  const auto in_MN = [](double newton) { return newton / 1e6; };
  for (const auto& p : metrics["passes"]) {
    fmt::print(
        "pass {}: {:.1f} t in the dipper, {:.1f} t in the truck, {:.2f} t spilt, dig force "
        "{:.2f} MN",
        p["pass"].get<int>(), p["payload_kg"].get<double>() / 1e3,
        p["truck_kg"].get<double>() / 1e3, p["spillage_kg"].get<double>() / 1e3,
        in_MN(p["dig_force_mean_N"]));
    if (p.contains("dig_phases_force_mean_N"))
      fmt::print(" ({:.2f} MN from penetrate to breakout)", in_MN(p["dig_phases_force_mean_N"]));
    fmt::print("\n");
  }
}

}  // namespace

int report_command(const ReportWords& words) {
  try {
    fs::path folder = words.out.empty() ? fs::path(words.folder) / "report" : fs::path(words.out);
    if (!folder.has_filename()) folder = folder.parent_path();  // was given as "there/"
    refuse_unwritable(folder);
    analysis::run::RunFolder run = open_folder(words);
    const analysis::io::DumpFolder dumps =
        analysis::io::open_dump_folder(words.folder, words.timestep_s);
    if (run.is_run) analysis::run::check_dumps_are_of(run, dumps);
    const analysis::metrics::Metrics metrics = analysis::metrics::compute_metrics(run, dumps);
    analysis::metrics::write_report(metrics, folder, [&](const fs::path& made) {
      analysis::report::write_run_page(run, dumps, metrics.values, made / "report.html");
      analysis::metrics::write_paraview_files(dumps, made, fs::absolute(folder));
    });
    print_passes(metrics.values);
    fmt::print("{}\n", (folder / "report.html").string());
    return 0;
  } catch (const InputError& e) {
    fmt::print(stderr, "dipper: {}\n", e.what());
    return 2;
  }
}

}  // namespace dipper::cli
