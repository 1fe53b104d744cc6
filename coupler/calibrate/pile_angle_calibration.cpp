#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "common/text_file.hpp"
#include "common/version.hpp"
#include "coupler/calibrate/calibration.hpp"
#include "coupler/calibrate/calibration_decks.hpp"
#include "coupler/calibrate/measured_run.hpp"
#include "coupler/calibrate/request_check.hpp"
#include "coupler/calibrate/response_surface.hpp"
#include "coupler/calibrate/search_scale.hpp"

namespace dipper::calibrate {
namespace {

using Json = nlohmann::ordered_json;
using Parameters = std::vector<std::pair<std::string, double>>;

constexpr int kSearchSeeds = 2;   // at each point of the design
constexpr int kConfirmSeeds = 5;  // at the case as it is, or at the values found

/// The case's values of the searched keys; checked_request has checked that they are numbers.
std::vector<double> values_of(const cases::Case& c, const std::vector<SearchRange>& ranges) {
  std::vector<double> out;
  for (const SearchRange& r : ranges) out.push_back(value_of(c, r.key).value());
  return out;
}

class PileCalibration {
 public:
  PileCalibration(const CalibrationRequest& request, const cases::Case& c, Reporter& reporter)
      : request_(request),
        case_(c),
        reporter_(reporter),
        rig_(pile_rig(c, request.size_m)),
        scale_(request.search) {
    if (request_.target <= 0) request_.target = kPaperPileAngle_deg;
  }

  int run() {
    const std::vector<double> rocks = poured_rocks(case_, poured_mass(case_, rig_));
    const std::string missing = missing_classes(case_, rocks);
    if (!missing.empty() || rig_.size_m < 3 * largest_rock(case_)) {
      reporter_.line(fmt::format(
          "--size {:g} m is too small{}: the pile must be at least 3 of the largest rocks "
          "({:.3g} m) high",
          rig_.size_m, missing.empty() ? "" : ", it has " + missing, 3 * largest_rock(case_)));
      return 2;
    }
    std::vector<PlannedRun> plan =
        request_.search.empty() ? seeds_at("case", {}, seeds(kConfirmSeeds)) : search_plan();
    announce(plan, std::accumulate(rocks.begin(), rocks.end(), 0.0));
    runs_ = make(plan);
    if (request_.search.empty()) return measured();
    return searched();
  }

 private:
  std::vector<PlannedRun> seeds_at(const std::string& stage, const Parameters& p, int n) const {
    std::vector<PlannedRun> out;
    for (int k = 0; k < n; ++k)
      out.push_back({stage, p, pile_run(changed_case(request_, p, case_.seed + k), rig_)});
    return out;
  }

  int seeds(int otherwise) const { return request_.seeds > 0 ? request_.seeds : otherwise; }

  std::vector<PlannedRun> search_plan() {
    std::vector<PlannedRun> plan;
    for (const Point& x : composite_design(static_cast<int>(request_.search.size())))
      for (PlannedRun& p : seeds_at("search", scale_.values(x), seeds(kSearchSeeds)))
        plan.push_back(std::move(p));
    return plan;
  }

  void announce(const std::vector<PlannedRun>& plan, double rocks) const {
    std::vector<DeckRun> decks;
    for (const PlannedRun& p : plan) decks.push_back(p.run);
    const std::vector<bool> there = cached_runs(decks);
    reporter_.line(fmt::format(
        "pile angle: sheet lifted {:.3g} m at {:.2f} m/s, {:.3g} m wide, about {:.0f} rocks",
        rig_.size_m, 0.61 * std::sqrt(rig_.size_m / 12.2), rig_.width_m, rocks));
    reporter_.line(fmt::format(
        "{} runs ({} kept from before){}, {} at a time", plan.size(),
        std::count(there.begin(), there.end(), true),
        request_.search.empty() ? "" : fmt::format(", then {} at the set found", kConfirmSeeds),
        jobs_of(request_)));
  }

  std::vector<MeasuredRun> make(const std::vector<PlannedRun>& plan) const {
    return make_runs(
        plan, jobs_of(request_), reporter_, [&](const DeckRun&, const std::filesystem::path& dump) {
          const analysis::rock::PileAngle a = measure_pile(dump, rig_);
          return Measures{
              {"angle_deg", a.angle_deg}, {"fit_sigma_deg", a.sigma_deg}, {"height_m", a.height_m}};
        });
  }

  Json about() const {
    return {{"what", "pile-angle"},
            {"case", case_.name},
            {"version", version()},
            {"target_deg", request_.target},
            {"target_sigma_deg", request_.sigma},
            {"lift_m", rig_.size_m},
            {"width_m", rig_.width_m},
            {"depth_m", rig_.depth_m}};
  }

  bool on_target(const MeanOfSeeds& m) const {
    return std::abs(m.mean - request_.target) <= request_.sigma;
  }

  Json summary_of(const MeanOfSeeds& m) const {
    const double off = m.mean - request_.target;
    return {{"mean_deg", m.mean}, {"seed_sigma_deg", m.sigma}, {"mean_sigma_deg", m.sigma_of_mean},
            {"seeds", m.n},       {"off_target_deg", off},     {"on_target", on_target(m)}};
  }

  void print_mean(const char* of, const MeanOfSeeds& m) const {
    reporter_.line(fmt::format(
        "{}: {:.2f} +- {:.2f} deg over {} seeds (one run: +- {:.2f}); target {:g} +- {:g}: {}", of,
        m.mean, m.sigma_of_mean, m.n, m.sigma, request_.target, request_.sigma,
        on_target(m) ? "met" : "missed"));
  }

  void write(const Json& json) const {
    std::filesystem::create_directories(request_.out);
    write_runs_csv(runs_, request_.out / "runs.csv");
    write_text(request_.out / "calibration.json", json.dump(1) + '\n');
    reporter_.line(fmt::format(
        "{}: runs.csv, calibration.json{}", request_.out.string(),
        std::filesystem::exists(request_.out / "calibrated.set") ? ", calibrated.set" : ""));
  }

  int measured() {
    const MeanOfSeeds m = mean_of_seeds(runs_, "case");
    print_mean("the case as it is", m);
    Json json = about();
    json["result"] = summary_of(m);
    write(json);
    return 0;
  }

  int searched() {
    std::vector<Point> x;
    std::vector<double> y;
    for (const MeasuredRun& r : runs_) {
      std::vector<double> values;
      for (const auto& p : r.parameters) values.push_back(p.second);
      x.push_back(scale_.point(values));
      y.push_back(r.value());
    }
    const ResponseSurface surface(x, y);
    Json json = about();
    json["surface"] = describe(surface, seed_sigma(x, y));
    const auto found =
        nearest_with(surface, request_.target, scale_.point(values_of(case_, request_.search)));
    if (!found) {
      const auto [least, most] = std::minmax_element(y.begin(), y.end());
      reporter_.line(fmt::format(
          "no values in these ranges give {:g} deg: the runs gave {:.1f} to {:.1f} deg; "
          "search wider, or another key",
          request_.target, *least, *most));
      json["found"] = nullptr;
      write(json);
      return 0;
    }
    json["found"] = describe(surface, *found);
    const Parameters set = scale_.values(*found);
    reporter_.line(fmt::format("confirming with {} seeds", kConfirmSeeds));
    for (MeasuredRun& r : make(seeds_at("confirm", set, kConfirmSeeds)))
      runs_.push_back(std::move(r));
    const MeanOfSeeds m = mean_of_seeds(runs_, "confirm");
    print_mean("the set found", m);
    json["confirmed"] = summary_of(m);
    std::filesystem::create_directories(request_.out);
    const bool met = on_target(m);
    if (met) write_overlay(set, request_.out / "calibrated.set");
    write(json);
    if (!met) return 0;
    reporter_.line(run_command(request_, set));
    return 0;
  }

  Json describe(const ResponseSurface& s, std::optional<double> seeds) const {
    reporter_.line(fmt::format(
        "surface: one run lies {:.2f} deg about it ({} degrees of freedom){}", s.residual_sigma(),
        s.degrees_of_freedom(), seeds ? fmt::format("; seeds alone: {:.2f} deg", *seeds) : ""));
    const Eigen::VectorXd& c = s.coefficients();
    Json out = {{"coefficients", std::vector<double>(c.data(), c.data() + c.size())},
                {"of", "1, x_i, x_i x_j (i <= j); x from -1 to 1 over each range"},
                {"residual_sigma_deg", s.residual_sigma()},
                {"degrees_of_freedom", s.degrees_of_freedom()}};
    out["seed_sigma_deg"] = seeds ? Json(*seeds) : Json(nullptr);
    for (const SearchRange& r : request_.search) out["ranges"][r.key] = {r.low, r.high};
    return out;
  }

  /// The values found, how well the angle determines them, and other values that give the same
  /// angle.
  Json describe(const ResponseSurface& s, const Point& x) const {
    const Prediction p = s.at(x);
    const Point g = s.gradient(x);
    const double sigma = std::hypot(request_.sigma, p.sigma);
    Json out = {{"predicted_deg", p.value}, {"predicted_sigma_deg", p.sigma}};
    const Parameters set = scale_.values(x);
    reporter_.line(fmt::format("set found, predicted {:.2f} +- {:.2f} deg:", p.value, p.sigma));
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double slope = g[static_cast<Eigen::Index>(i)] / scale_.half(i);
      out["set"][set[i].first] = {{"value", set[i].second},
                                  {"deg_per_unit", slope},
                                  {"sigma_alone", sigma / std::abs(slope)}};
      reporter_.line(
          fmt::format("  {} = {:.4g} (+- {:.2g} with the others fixed: {:.3g} deg a unit)",
                      set[i].first, set[i].second, sigma / std::abs(slope), slope));
    }
    out["unique"] = false;
    const std::vector<Point> lines = neutral_directions(s, x);
    if (lines.empty()) {
      reporter_.line(
          "one angle determines one value: with another key changed, another value would fit. "
          "Search two keys to see which pairs fit");
      out["note"] = "one key searched: unique in it alone, not among sets of several keys";
      return out;
    }
    reporter_.line("the set is not unique; the angle stays the same along");
    for (const Point& line : lines) {
      Json direction, ends = Json::array();
      std::string words;
      for (std::size_t i = 0; i < set.size(); ++i) {
        const double unit = line[static_cast<Eigen::Index>(i)] * scale_.half(i);
        direction[set[i].first] = unit;
        words += fmt::format("{}{} {:+.3g}", i == 0 ? "" : ", ", set[i].first, unit);
      }
      std::string from_to;
      for (const double way : {-1.0, 1.0}) {
        Json end;
        for (const auto& [key, value] : scale_.values(follow(s, x, way * line))) {
          end[key] = value;
          from_to +=
              fmt::format("{}{:.4g}", end.size() == 1 ? (way < 0 ? "" : " to (") : ", ", value);
        }
        from_to += ")";
        ends.push_back(end);
      }
      reporter_.line(fmt::format("  {}: in these ranges from ({}", words, from_to));
      out["neutral"].push_back({{"direction", direction}, {"ends", ends}});
    }
    return out;
  }

  CalibrationRequest request_;
  cases::Case case_;
  Reporter& reporter_;
  PileRig rig_;
  SearchScale scale_;
  std::vector<MeasuredRun> runs_;
};

}  // namespace

int calibrate_pile_angle(const CalibrationRequest& request, Reporter& reporter) {
  const std::optional<cases::Case> c = checked_request(request, reporter);
  return c ? PileCalibration(request, *c, reporter).run() : 2;
}

}  // namespace dipper::calibrate
