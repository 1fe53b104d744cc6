#include "coupler/result/truck_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

constexpr double kMayBe = 1.1, kNever = 1.2;  // of the rated load: one in ten loads, no load
constexpr double kMost = 1e9;                 // passes; an int holds it

std::string plural(int n) { return fmt::format("{} pass{}", n, n == 1 ? "" : "es"); }

}  // namespace

std::optional<TruckLoad> truck_load(double rated_t, const json& passes) {
  if (!(rated_t > 0)) return std::nullopt;
  TruckLoad out;
  out.rated_t = rated_t;
  std::vector<double> after;  // each pass
  for (const json& p : passes) {
    if (!p.value("dumped", true)) continue;
    out.load_t += 1e-3 * p.value("truck_kg", 0.0);
    after.push_back(out.load_t);
  }
  out.passes = static_cast<int>(after.size());
  if (out.passes == 0 || out.load_t <= 0) return std::nullopt;
  out.mean_pass_t = out.load_t / out.passes;
  // The run's own passes, then as many of the mean one as come nearest.
  const double missing = (rated_t - out.load_t) / out.mean_pass_t;
  const int further = static_cast<int>(std::min(std::max(std::ceil(missing - 0.5), 0.0), kMost));
  after.push_back(out.load_t + further * out.mean_pass_t);
  const auto off_t = [&](double load_t) { return std::abs(load_t - rated_t); };
  const auto best = std::min_element(after.begin(), after.end(),
                                     [&](double a, double b) { return off_t(a) < off_t(b); });
  out.filled_t = *best;
  const bool own = best + 1 != after.end();
  out.passes_to_fill = own ? static_cast<int>(best - after.begin()) + 1 : out.passes + further;
  return out;
}

std::string no_truck_load(double rated_t, const json& passes) {
  if (!(rated_t > 0)) return {};
  if (passes.empty()) return "truck.rated_t has no effect: the run has no passes";
  const auto dumped = [](const json& p) { return p.value("dumped", true); };
  const auto count = static_cast<int>(std::count_if(passes.begin(), passes.end(), dumped));
  if (count == 0) return {};
  return fmt::format(
      "truck.rated_t: the truck has gained nothing from {}, so the number that fills it is unknown",
      plural(count));
}

json as_json(const TruckLoad& l) {
  return {{"rated_t", l.rated_t},         {"passes", l.passes},
          {"load_t", l.load_t},           {"load_fraction", l.load_t / l.rated_t},
          {"mean_pass_t", l.mean_pass_t}, {"passes_to_fill", l.passes_to_fill},
          {"filled_t", l.filled_t},       {"filled_fraction", l.filled_t / l.rated_t}};
}

std::string to_text(const TruckLoad& l) {
  const double percent = 100 * (l.filled_t / l.rated_t - 1);
  std::string text =
      fmt::format("{} fill{} it with {:.0f} t, {:.0f} % {} its rated {:g} t",
                  plural(l.passes_to_fill), l.passes_to_fill == 1 ? "s" : "", l.filled_t,
                  std::abs(percent), percent > 0 ? "over" : "under", l.rated_t);
  if (l.passes_to_fill > l.passes)
    text += fmt::format(", if further passes load the mean {:.0f} t", l.mean_pass_t);
  if (l.passes_to_fill != l.passes)
    text += fmt::format("; after {} it has {:.0f} t, {:.0f} % of it", plural(l.passes), l.load_t,
                        100 * l.load_t / l.rated_t);
  return text;
}

std::string overload_warning(const TruckLoad& l) {
  const double load_t = std::max(l.load_t, l.filled_t), fraction = load_t / l.rated_t;
  if (fraction <= kMayBe) return {};
  return fmt::format(
      "the truck is overloaded: {:.0f} t after {}, {:.0f} % of its rated {:g} t; by the 10/10/20 "
      "rule {}",
      load_t, plural(std::max(l.load_t >= l.filled_t ? l.passes : l.passes_to_fill, 1)),
      100 * fraction, l.rated_t,
      fraction > kNever ? "no load exceeds 120 %" : "no more than one load in ten exceeds 110 %");
}

}  // namespace dipper::result
