#include "coupler/cli/calibrate_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "common/numbers.hpp"
#include "common/range.hpp"
#include "common/resolved_path.hpp"
#include "coupler/calibrate/calibration.hpp"
#include "coupler/cli/number_option.hpp"
#include "coupler/cli/set_option.hpp"
#include "coupler/launch/interrupt.hpp"

namespace dipper::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateOptions {
  std::string what, folder, out;
  std::vector<std::string> set, search;
  std::optional<long> seed;
  calibrate::CalibrationRequest request;
};

std::optional<double> number(const std::string& text) {
  double value = 0;
  return parse_number(text, value) ? std::optional(value) : std::nullopt;
}

calibrate::SearchRange range_of(const std::string& text) {
  const auto equals = text.find('='),
             colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals != std::string::npos && colon != std::string::npos) {
    const auto low = number(text.substr(equals + 1, colon - equals - 1));
    const auto high = number(text.substr(colon + 1));
    if (low && high) return {text.substr(0, equals), *low, *high};
  }
  throw CLI::ValidationError(
      "--search " + text,
      "write KEY=LOW:HIGH, as in --search contact.rolling_friction_sphere=0.05:0.3");
}

/// runs/calibrate-WHAT-CASE, or that with -2, -3, ...: results are never overwritten.
fs::path free_folder(const CalibrateOptions& o) {
  const fs::path name = resolved(o.folder).filename();
  const fs::path first = fs::path("runs") / fmt::format("calibrate-{}-{}", o.what, name.string());
  fs::path out = first;
  for (int k = 2; fs::exists(out); ++k) out = first.string() + fmt::format("-{}", k);
  return out;
}

int calibrate(CalibrateOptions& o, Reporter& reporter) {
  calibrate::CalibrationRequest& request = o.request;
  request.case_folder = o.folder;
  request.overrides = overrides_of(o.set, "rock.coarse_graining=3");
  if (o.seed) request.overrides.push_back({"seed", std::to_string(*o.seed)});
  for (const auto& s : o.search) request.search.push_back(range_of(s));
  request.out = o.out.empty() ? free_folder(o) : fs::path(o.out);
  launch::catch_interrupts();
  try {
    return o.what == "pile-angle" ? calibrate::calibrate_pile_angle(request, reporter)
                                  : calibrate::calibrate_bulk_density(request, reporter);
  } catch (const launch::Interrupted&) {
    reporter.error("interrupted; finished runs are kept, and the same command continues");
    return 4;
  }
}

}  // namespace

Command add_calibrate_command(CLI::App& app, Reporter& reporter) {
  const auto o = std::make_shared<CalibrateOptions>();
  calibrate::CalibrationRequest& request = o->request;
  auto* command =
      app.add_subcommand("calibrate", "the paper's calibrations: pile angle, bulk density");
  command->require_subcommand(1);
  command->footer("Options, with an example:\n  dipper help calibrate pile-angle");
  const auto add = [&](const char* name, const char* what, const char* target, const Range& targets,
                       const char* size) {
    auto* sub = command->add_subcommand(name, what);
    sub->footer(fmt::format(
        "Simulates the paper's measurement, finds the values with which the case reproduces it, "
        "and "
        "writes them to calibrated.set (docs/calibration.md). Example:\n  dipper calibrate {} "
        "cases/quick",
        name));
    sub->add_option("CASE", o->folder, "a folder with a case.yaml")->required();
    sub->add_option("--set", o->set, "KEY=VALUE: overrides the case");
    sub->add_option("--target", request.target, target)->check(number_in(targets));
    sub->add_option("--size", request.size_m, size)->check(number_in({0, 1000, true}));
    sub->add_option("--seeds", request.seeds, "runs per value, which differ in the seed only")
        ->check(whole_number_in({1, 1000}));
    sub->add_option("--seed", o->seed, "the first seed (default: the case's)")
        ->check(whole_number_in(kSeeds));
    sub->add_option("--jobs", request.jobs, "runs at once (default: one a core)")
        ->check(whole_number_in({1, 1000}));
    sub->add_option("--out", o->out, "folder of the results (default: runs/calibrate-...)");
    sub->callback([o, name] { o->what = name; });
    return sub;
  };
  auto* pile =
      add("pile-angle", "the angle at which rock comes to rest when a sheet is lifted",
          "angle in deg (default: 34.7, the paper's mean of six piles)", {0, 90, true, true},
          "lift of the sheet in m (default: 7 of the largest rocks; the paper: 12.2)");
  pile->add_option("--search", o->search, "KEY=LOW:HIGH: find the value that gives the target");
  pile->add_option("--sigma", request.sigma, "uncertainty of the target in deg (default: 1)")
      ->check(number_in({0, 90, true}));
  add("bulk-density", "the density of the rock at which a box of it has the bulk density",
      "density in kg/m3 (default: the case's rock.bulk_density_kg_m3)", {100, 20000},
      "edge of the box in m (default: 5 of the largest rocks, at least the paper's 3.037)");
  return {command, [o, &reporter] { return calibrate(*o, reporter); }};
}

}  // namespace dipper::cli
