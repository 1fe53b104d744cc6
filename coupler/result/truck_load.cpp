#include "coupler/result/truck_load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

constexpr double kMayBe = 1.1, kNever = 1.2;  // of the rated load: one in ten loads, no load
constexpr int kMostPasses = 1000;

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
  double least = INFINITY;
  for (int n = 1; n <= kMostPasses; ++n) {
    const double load_t = n <= out.passes ? after[static_cast<std::size_t>(n) - 1]
                                          : out.load_t + (n - out.passes) * out.mean_pass_t;
    const double off_t = std::abs(load_t - rated_t);
    if (off_t < least) {
      least = off_t;
      out.passes_to_fill = n;
      out.filled_t = load_t;
    } else if (n > out.passes) {
      break;
    }
  }
  return out;
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
