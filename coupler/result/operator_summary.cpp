#include "coupler/result/operator_summary.hpp"

#include <fmt/format.h>

#include <fstream>
#include <vector>

#include "common/record/record.hpp"

namespace dipper::result {
namespace {

using json = nlohmann::ordered_json;

json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return in ? json::parse(in, nullptr, false) : json();
}

}  // namespace

json operator_summary(const cases::Case& c, const RunFolder& folder) {
  if (c.machine.operated_by != cases::OperatorKind::plan) return nullptr;
  std::vector<double> begun_s;
  double back_s = 0;  // sum over the returns
  for (int pass = 1;; ++pass) {
    const json one = read_json(folder.decisions() / fmt::format("pass_{}.json", pass));
    if (!one.is_object() || one.at("chosen").is_null()) break;
    begun_s.push_back(one.at("t_s"));
    if (pass > 1) back_s += one.at("dig_at_s").get<double>() - one.at("begins_at_s").get<double>();
  }
  const auto time_s = record::read_channel(folder.record(), "time_s");
  const auto truck = record::read_channel(folder.record(), "rock/mass_in_truck");
  const auto work = record::read_channel(folder.record(), "machine/drive_work");
  if (begun_s.empty() || time_s.empty()) return nullptr;
  const json end = read_json(folder.decisions() / "end.json");
  const double done_s = end.is_object() ? end.at("t_s").get<double>() : time_s.back();
  const auto passes = static_cast<double>(begun_s.size());
  json out = {{"passes", begun_s.size()},
              {"stopped", end.is_object() ? end.at("reason") : json()},
              {"cycles_s", json::array()}};
  for (std::size_t k = 1; k < begun_s.size(); ++k)
    out["cycles_s"].push_back((k + 1 < begun_s.size() ? begun_s[k + 1] : done_s) - begun_s[k]);
  // The first pass gets a return as well: the mean of the others'.
  const double truck_s = done_s - begun_s.front() + (passes > 1 ? back_s / (passes - 1) : 0);
  const double kg = truck.back();
  out["truck_kg"] = kg;
  out["truck_s"] = truck_s;
  out["tonnes_per_hour"] = truck_s > 0 ? json(kg * 1e-3 / truck_s * 3600) : json();
  out["energy_J_per_kg"] = kg > 0 ? json(work.back() / kg) : json();
  return out;
}

}  // namespace dipper::result
