#include "coupler/result/operator_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "common/json_text.hpp"
#include "common/record/record.hpp"

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

constexpr double kRounding_s = 1e-6;

}  // namespace

json operator_summary(const cases::Case& c, const RunFolder& folder) {
  if (c.machine.operated_by != cases::OperatorKind::plan) return nullptr;
  std::vector<double> begun_s, to_dig_s;  // of each pass; from where its motion begins to the dig
  for (int pass = 1;; ++pass) {
    const nlohmann::json one =
        read_json_or_discard(folder.decisions() / fmt::format("pass_{}.json", pass));
    if (!one.is_object() || one.at("chosen").is_null()) break;
    begun_s.push_back(one.at("t_s"));
    to_dig_s.push_back(one.at("dig_at_s").get<double>() - one.at("begins_at_s").get<double>());
  }
  const nlohmann::json end = read_json_or_discard(folder.decisions() / "end.json");
  const bool stopped = end.is_object();
  if (begun_s.empty() && stopped) return {{"passes", 0}, {"stopped", end.at("reason")}};
  const auto time_s = record::read_channel(folder.record(), "time_s");
  const auto truck = record::read_channel(folder.record(), "rock/mass_in_truck");
  const auto work = record::read_channel(folder.record(), "machine/drive_work");
  if (begun_s.empty() || time_s.empty()) return nullptr;
  // A pass that the end of the run interrupts has no cycle, and its work no load.
  const std::size_t passes = begun_s.size() - (stopped ? 0 : 1);
  const double done_s = stopped ? end.at("t_s").get<double>() : begun_s.back();
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), done_s + kRounding_s);
  const auto last =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - time_s.begin(), 1)) - 1;

  json out = {{"passes", passes},
              {"stopped", stopped ? json(end.at("reason")) : json()},
              {"cycles_s", json::array()}};
  for (std::size_t k = 1; k < passes; ++k)
    out["cycles_s"].push_back((k + 1 < begun_s.size() ? begun_s[k + 1] : done_s) - begun_s[k]);
  json truck_s;
  if (passes > 1) {
    const double others_s = std::accumulate(to_dig_s.begin() + 1, to_dig_s.begin() + passes, 0.0);
    truck_s =
        done_s - begun_s.front() - to_dig_s.front() + others_s / static_cast<double>(passes - 1);
  }
  const double kg = truck.at(last);
  out["truck_kg"] = kg;
  out["truck_s"] = truck_s;
  out["tonnes_per_hour"] =
      truck_s.is_null() ? json() : json(kg * 1e-3 / truck_s.get<double>() * 3600);
  out["energy_J_per_kg"] = passes > 0 && kg > 0 ? json(work.at(last) / kg) : json();
  return out;
}

}  // namespace dipper::result
