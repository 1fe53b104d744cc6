#include "coupler/cli/report_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "analysis/metrics/paraview_files.hpp"
#include "analysis/metrics/report_files.hpp"
#include "analysis/report/dry_page.hpp"
#include "analysis/report/run_page.hpp"
#include "analysis/run/figure.hpp"
#include "analysis/run/run_folder.hpp"
#include "common/file_lock.hpp"
#include "common/input_error.hpp"
#include "coupler/cli/number_option.hpp"
#include "coupler/cli/output_file.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

/// A run without rock has no dumps, and a page when it has ended only.
void refuse_unfinished(const fs::path& folder) {
  const fs::path dumps = folder / "dumps", lock = folder / "run.lock";
  if (!fs::exists(lock) || (fs::is_directory(dumps) && !fs::is_empty(dumps))) return;
  if (FileLock writer(lock); access(folder.c_str(), W_OK) == 0 && !writer.try_lock())
    throw InputError({{folder, 0, "", "a run is writing it; wait for its end"}});
}

void refuse_options_of_dumps(const ReportOptions& options) {
  if (options.mesh.empty() && options.poses.empty()) return;
  throw InputError({{options.folder, 0, "",
                     "has a record of its own; --mesh and --poses are for dumps of other "
                     "programs"}});
}

analysis::run::RunData open_folder(const ReportOptions& options) {
  const fs::path folder = options.folder;
  if (fs::exists(folder / "record.h5") || fs::exists(folder / "case.txt")) {
    refuse_options_of_dumps(options);
    return analysis::run::read_run_folder(options.folder);
  }
  if (options.mesh.empty() != options.poses.empty())
    throw InputError({{{}, 0, "--mesh and --poses", "each needs the other; give both"}});
  std::optional<analysis::run::ForeignDipper> dipper;
  if (!options.mesh.empty()) dipper = analysis::run::ForeignDipper{options.mesh, options.poses};
  return analysis::run::read_foreign_folder(options.folder, dipper);
}

/// A report replaces its folder, which may only be that of an earlier report.
void refuse_what_would_be_lost(const fs::path& folder, const fs::path& source) {
  if (!fs::exists(folder)) return;
  const auto away = fs::relative(fs::canonical(source), fs::canonical(folder));
  const bool around = *away.begin() != "..";  // it is the folder, or lies in it
  if (fs::is_directory(folder) && !around &&
      (fs::is_empty(folder) || fs::exists(folder / "metrics.json")))
    return;
  throw InputError({{folder, 0, "",
                     "exists and is not a report, and a report would replace it; choose another "
                     "folder with --out"}});
}

void report_passes(const nlohmann::ordered_json& metrics, Reporter& reporter) {
  if (!metrics.contains("passes")) return;
  const auto in_MN = [](double newton) { return newton / 1e6; };
  for (const auto& p : metrics["passes"]) {
    std::string line =
        fmt::format("pass {}: {:.1f} t in the dipper, {:.1f} t in the truck", p["pass"].get<int>(),
                    p["payload_kg"].get<double>() / 1e3, p["truck_kg"].get<double>() / 1e3);
    if (p.contains("spillage_kg"))
      line += fmt::format(", {:.2f} t spilt", p["spillage_kg"].get<double>() / 1e3);
    line += fmt::format(", mean dig force {:.2f} MN to the dump", in_MN(p["dig_force_mean_N"]));
    if (p.contains("dig_phases_force_mean_N"))
      line += fmt::format(", {:.2f} MN over the dig", in_MN(p["dig_phases_force_mean_N"]));
    reporter.line(line);
  }
}

}  // namespace

int report_command(const ReportOptions& options, Reporter& reporter) {
  try {
    if (!fs::is_directory(options.folder))
      throw InputError(
          {{options.folder, 0, "", "no such folder; give that of a run, or of LIGGGHTS's dumps"}});
    fs::path folder =
        options.out.empty() ? fs::path(options.folder) / "report" : fs::path(options.out);
    if (!folder.has_filename()) folder = folder.parent_path();     // was given as "there/"
    require_place(folder, "name the report's folder with --out");  // the run may be another user's
    if (const std::string obstacle = analysis::report::film_obstacle(options.film);
        !obstacle.empty())
      throw InputError({{{}, 0, "", obstacle}});
    refuse_what_would_be_lost(folder, options.folder);
    if (analysis::report::is_dry_run(options.folder)) {
      refuse_options_of_dumps(options);
      if (options.film.any())
        throw InputError({{options.folder, 0, "", "a run without rock has no replay to film"}});
      fs::create_directories(folder);
      analysis::report::write_dry_page(options.folder, folder / "report.html");
      reporter.line((folder / "report.html").string());
      return 0;
    }
    refuse_unfinished(options.folder);
    analysis::run::RunData run = open_folder(options);
    analysis::io::DumpFolder dumps =
        analysis::io::open_dump_folder(options.folder, options.timestep_s);
    if (run.is_run) {
      analysis::run::keep_recorded(run, dumps);
      analysis::run::check_dumps_are_of(run, dumps);
    }
    if (!run.is_run && !run.dipper.empty())
      for (const Finding& warning :
           analysis::run::check_dipper_is_among(run, dumps, {options.mesh, options.poses}))
        reporter.line("warning: " + to_string(warning));
    const analysis::run::Figure figure = analysis::run::read_figure(run);
    const analysis::metrics::Metrics metrics = analysis::metrics::compute_metrics(run, dumps);
    analysis::metrics::write_report(metrics, folder, [&](const fs::path& made) {
      analysis::report::write_run_page(run, dumps, metrics.values, figure, made / "report.html");
      analysis::metrics::write_paraview_files(run, dumps, figure, made);
    });
    report_passes(metrics.values, reporter);
    reporter.line((folder / "report.html").string());
    if (options.film.any())
      analysis::report::write_film(folder / "report.html", options.film, reporter);
    return 0;
  } catch (const InputError& e) {
    reporter.error(e.what());
    return 2;
  }
}

Command add_report_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<ReportOptions>();
  auto* sub = app.add_subcommand("report", "report page, metrics and tables of a run, or of dumps");
  sub->footer(
      "Writes report.html, metrics.json, tables and ParaView's files, also for dumps of plain "
      "LIGGGHTS. Example:\n  dipper report runs/quick --poster dig.png");
  sub->add_option("DIR", o->folder, "a run's folder, or a folder of LIGGGHTS dumps")->required();
  sub->add_option("--out", o->out, "the report's folder (default: DIR/report)");
  sub->add_option("--timestep", o->timestep_s, "DEM step in s, when no file has it")
      ->check(number_in({0, 1, true}));
  sub->add_option("--mesh", o->mesh, "the dipper's STL, for dumps without a record");
  sub->add_option("--poses", o->poses, "its poses, CSV: time_s,x_m,y_m,z_m,qw,qx,qy,qz");
  sub->add_option("--video", o->film.video, "the dig as an .mp4; needs chromium and ffmpeg");
  sub->add_option("--poster", o->film.poster,
                  "a picture of the fullest moment of the dig, .png or .jpg; needs chromium");
  return {sub, [o, &reporter] { return report_command(*o, reporter); }};
}

}  // namespace dipper::cli
