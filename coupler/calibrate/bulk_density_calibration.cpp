#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/calibrate/calibration.hpp"
#include "coupler/calibrate/calibration_decks.hpp"
#include "coupler/calibrate/measured_run.hpp"
#include "coupler/calibrate/request_check.hpp"

namespace dipper::calibrate {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSeeds = 5;
constexpr double kSmallestBox = 4;  // edge in largest rocks; the paper's box has 3.6 of its 850 mm
const char* const kKey = "rock.density_kg_m3";

class BoxCalibration {
 public:
  BoxCalibration(const CalibrationRequest& request, const cases::Case& c, Reporter& reporter)
      : request_(request), case_(c), reporter_(reporter) {
    const double d = largest_rock(c);
    rig_.edge_m = request.size_m > 0 ? request.size_m : std::max(kPaperBox_m, kBoxEdge * d);
    if (request_.target <= 0) request_.target = c.rock.bulk_density_kg_m3;
    if (request_.seeds <= 0) request_.seeds = kSeeds;
  }

  int run() {
    if (case_.rock.fines_fraction > 0) {
      reporter_.line(
          "rock.fines_fraction: the box is weighed without fines; write --set "
          "rock.fines_fraction=0");
      return 2;
    }
    const double own = case_.rock.density_kg_m3;
    const cases::Case same = changed_case(request_, {{kKey, own}}, case_.seed);
    if (std::abs(same.rock.density_kg_m3 / own - 1) > 1e-6) {
      reporter_.line(fmt::format(
          "{}: an effect changes this key; calibrate the case without that effect", kKey));
      return 2;
    }
    const double d = largest_rock(case_);
    const std::vector<double> rocks = poured_rocks(case_, poured_mass(case_, rig_));
    const std::string missing = missing_classes(case_, rocks);
    if (rig_.edge_m < kSmallestBox * d - 1e-9 || !missing.empty()) {
      reporter_.line(fmt::format(
          "--size {:g} m is too small{}: the box must be at least {:g} of the largest rocks "
          "wide, {:.3g} m",
          rig_.edge_m, missing.empty() ? "" : ", it has " + missing, kSmallestBox,
          kSmallestBox * d));
      return 2;
    }
    const std::vector<PlannedRun> first = plan("case", case_.rock.density_kg_m3);
    std::vector<DeckRun> decks;
    for (const PlannedRun& p : first) decks.push_back(p.run);
    const std::vector<bool> there = cached_runs(decks);
    reporter_.line(fmt::format(
        "bulk density: box of {:.3g} m edge, {:.3g} m3, {:.2g} of the largest rocks wide, "
        "about {:.0f} rocks\n{} runs ({} kept from before), then as many with the scaled "
        "density, {} at a time",
        rig_.edge_m, std::pow(rig_.edge_m, 3), rig_.edge_m / d,
        std::accumulate(rocks.begin(), rocks.end(), 0.0), first.size(),
        std::count(there.begin(), there.end(), true), jobs_of(request_)));
    std::vector<MeasuredRun> runs = make(first);
    const MeanOfSeeds before = mean_of_seeds(runs, "case");
    print("the case as it is", case_.rock.density_kg_m3, before, interior(runs, "case"));
    // Rock is stiff: its packing does not depend on its density, so one step is enough.
    const double density = case_.rock.density_kg_m3 * request_.target / before.mean;
    for (MeasuredRun& r : make(plan("confirm", density))) runs.push_back(std::move(r));
    const MeanOfSeeds after = mean_of_seeds(runs, "confirm");
    print("scaled", density, after, interior(runs, "confirm"));
    const bool met = std::abs(after.mean / request_.target - 1) <= 0.01;
    reporter_.line(
        fmt::format("target {:g} kg/m3 +- 1 %: {}", request_.target, met ? "met" : "missed"));

    std::filesystem::create_directories(request_.out);
    write_runs_csv(runs, request_.out / "runs.csv");
    if (met) write_overlay({{kKey, density}}, request_.out / "calibrated.set");
    const Json json = {
        {"what", "bulk-density"},
        {"case", case_.name},
        {"version", version()},
        {"target_kg_m3", request_.target},
        {"edge_m", rig_.edge_m},
        {"case_as_it_is", summary(case_.rock.density_kg_m3, before, interior(runs, "case"))},
        {"confirmed", summary(density, after, interior(runs, "confirm"))},
        {"on_target", met}};
    write_text(request_.out / "calibration.json", json.dump(1) + '\n');
    reporter_.line(fmt::format("{}: runs.csv, calibration.json{}", request_.out.string(),
                               met ? ", calibrated.set" : ""));
    if (met) reporter_.line(run_command(request_, {{kKey, density}}));
    return 0;
  }

 private:
  std::vector<PlannedRun> plan(const std::string& stage, double density) const {
    std::vector<PlannedRun> out;
    const std::vector<std::pair<std::string, double>> set = {{kKey, density}};
    for (int k = 0; k < request_.seeds; ++k)
      out.push_back({stage, set, box_run(changed_case(request_, set, case_.seed + k), rig_)});
    return out;
  }

  std::vector<MeasuredRun> make(const std::vector<PlannedRun>& runs) const {
    return make_runs(
        runs, jobs_of(request_), reporter_,
        [&](const DeckRun& run, const std::filesystem::path& dump) {
          const BulkDensity b = measure_box(run.c, dump, rig_);
          return Measures{{"bulk_kg_m3", b.box_kg_m3}, {"interior_kg_m3", b.interior_kg_m3}};
        });
  }

  static double interior(const std::vector<MeasuredRun>& runs, const std::string& stage) {
    double sum = 0, n = 0;
    for (const MeasuredRun& r : runs)
      if (r.stage == stage) sum += r.measures[1].second, n += 1;
    return sum / n;
  }

  void print(const char* of, double density, const MeanOfSeeds& m, double inside) const {
    reporter_.line(fmt::format(
        "{}, rock of {:.1f} kg/m3: bulk {:.1f} +- {:.1f} kg/m3 over {} seeds (one run: +- "
        "{:.1f}); a rock's width off walls and floor {:.1f}: the walls cost {:.1f} %",
        of, density, m.mean, m.sigma_of_mean, m.n, m.sigma, inside, 100 * (1 - m.mean / inside)));
  }

  static Json summary(double density, const MeanOfSeeds& m, double inside) {
    return {{"rock_kg_m3", density},
            {"bulk_kg_m3", m.mean},
            {"seed_sigma_kg_m3", m.sigma},
            {"mean_sigma_kg_m3", m.sigma_of_mean},
            {"seeds", m.n},
            {"interior_kg_m3", inside},
            {"solid_fraction", m.mean / density}};
  }

  CalibrationRequest request_;
  cases::Case case_;
  Reporter& reporter_;
  BoxRig rig_;
};

}  // namespace

int calibrate_bulk_density(const CalibrationRequest& request, Reporter& reporter) {
  const std::optional<cases::Case> c = checked_request(request, reporter);
  return c ? BoxCalibration(request, *c, reporter).run() : 2;
}

}  // namespace dipper::calibrate
