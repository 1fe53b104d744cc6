#include "analysis/metrics/metric_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/metrics/pass_rows.hpp"

namespace dipper::analysis::metrics {
namespace {

double tonnes(double kg) { return kg / 1e3; }

/// The difference between the weight on the walls and the mass of the rocks inside.
std::string weight_note(const PassFacts& f) {
  const double difference = f.still->mass_kg - f.found.pass.payload_kg;
  std::string note =
      fmt::format("The weight on dipper and door differs from the rocks inside by {:+.2f} t",
                  tonnes(difference));
  if (!f.suspended)
    return note + "; no frame with velocities lies in that time, so the cause is unknown.";
  note += fmt::format(": {:+.2f} t is rock that rides outside the cavity",
                      tonnes(f.suspended->riding_kg));
  if (!f.suspended->accelerating_kg)
    return note + "; one frame does not show the load's acceleration.";
  const double rest = difference - f.suspended->riding_kg - *f.suspended->accelerating_kg;
  return note + fmt::format(
                    ", {:+.2f} t the load's acceleration (a load that starts to sink weighs less); "
                    "{:+.2f} t "
                    "remain, as the frames are too few to show both exactly.",
                    tonnes(*f.suspended->accelerating_kg), tonnes(rest));
}

/// The differences between the three payloads, in figures.
json payload_notes(const PassFacts& f) {
  json notes = json::array();
  json out = {{"inside_kg", f.found.pass.payload_kg}};
  if (f.still) {
    out["wrench_kg"] = f.still->mass_kg;
    out["still_from_s"] = f.still->from_s;
    out["still_to_s"] = f.still->to_s;
    if (f.suspended) {
      out["riding_outside_kg"] = f.suspended->riding_kg;
      if (f.suspended->accelerating_kg) out["accelerating_kg"] = *f.suspended->accelerating_kg;
    }
    notes.push_back(weight_note(f));
  } else if (!f.found.pass.dumped) {
    notes.push_back("The run ends before the load is dumped.");
  } else {
    notes.push_back("The dipper rose or sank in the last second before the door opened.");
  }
  out["truck_kg"] = f.found.pass.truck_kg;
  if (f.fate && f.found.pass.dumped) {
    notes.push_back(fmt::format(
        "Of {:.2f} t in the dipper before the swing, {:.2f} t came into the truck, {:.2f} t stayed "
        "in the dipper, {:.2f} t fell back on the pile and {:.2f} t fell elsewhere.",
        tonnes(f.fate->lifted_kg), tonnes(f.fate->truck_kg), tonnes(f.fate->carry_back_kg),
        tonnes(f.fate->back_in_pile_kg), tonnes(f.fate->spillage_kg)));
    if (std::abs(f.fate->truck_from_elsewhere_kg) > 1)
      notes.push_back(fmt::format("{:+.2f} t in the truck was not in the dipper before the swing.",
                                  tonnes(f.fate->truck_from_elsewhere_kg)));
  }
  out["notes"] = notes;
  return out;
}

}  // namespace

json run_table(const run::RunData& run, const io::DumpFolder& dumps, const Survey& survey) {
  json out;
  const auto copy = [&](const char* key) {
    if (run.summary.is_object() && run.summary.contains(key)) out[key] = run.summary[key];
  };
  copy("case");
  if (const std::string title = run.text("title"); !title.empty()) out["title"] = title;
  if (run.is_run) out["seed"] = static_cast<std::int64_t>(run.number("seed"));
  for (const auto& [key, text] : {std::pair{"version", run.version},
                                  {"case_hash", run.case_hash},
                                  {"rock_version", run.rock_version},
                                  {"machine_version", run.machine_version}})
    if (!text.empty()) out[key] = text;
  if (run.is_run) out["status"] = run.summary.is_object() ? run.summary["status"] : "unfinished";
  copy("state_hash");
  copy("warnings");
  copy("operator");
  copy("truck");
  out["sim_s"] = run.is_run ? run.signals.pass.time_s.back() : dumps.time_s.back();
  copy("cpu_s_per_sim_s");
  if (out.contains("cpu_s_per_sim_s"))
    out["cpu_s"] = out["cpu_s_per_sim_s"].get<double>() * out["sim_s"].get<double>();
  out["particles"] = survey.spheres;
  out["rocks"] = survey.rocks;
  return out;
}

json passes_table(const std::vector<PassFacts>& passes) {
  json out = json::array();
  for (const PassFacts& f : passes) {
    json row = pass_row(f);
    if (f.fate) {
      row["lifted_kg"] = f.fate->lifted_kg;
      row["carry_back_kg"] = f.fate->carry_back_kg;
      row["back_in_pile_kg"] = f.fate->back_in_pile_kg;
      row["spillage_kg"] = f.fate->spillage_kg;
      row["truck_from_elsewhere_kg"] = f.fate->truck_from_elsewhere_kg;
    }
    if (f.load) {
      row["load_volume_m3"] = f.load->volume_m3;
      row["load_bulk_density_kg_m3"] = f.load->bulk_density_kg_m3();
    }
    row["payload_ways"] = payload_notes(f);
    out.push_back(row);
  }
  return out;
}

json stages_table(const io::DumpFolder& dumps, const Survey& survey,
                  const std::vector<PassFacts>& passes) {
  json out = json::array();
  for (const PassFacts& f : passes) {
    for (const rock::Stage& s : f.stages) {
      const rock::FrameSums& sums = survey.frames[s.frame];
      out.push_back({{"pass", f.found.pass.pass},
                     {"stage", s.stage},
                     {"name", rock::stage_name(s.stage)},
                     {"t_s", dumps.time_s[s.frame]},
                     {"mass_kg", sums.in_dipper_kg},
                     {"flow_kg", sums.flow_kg},
                     {"bulk_kg", sums.bulk_kg},
                     {"ahead_kg", sums.ahead_kg}});
    }
  }
  return out;
}

json frames_table(const io::DumpFolder& dumps, const Survey& survey,
                  const rock::LoadRegions& regions) {
  json out = {{"time_s", dumps.time_s}};
  const auto column = [&](const char* name, auto value) {
    json& values = out[name] = json::array();
    for (const rock::FrameSums& f : survey.frames) values.push_back(value(f));
  };
  for (const io::DumpFrame& f : dumps.frames) out["step"].push_back(f.step);
  column("rock_kg", [](const rock::FrameSums& f) { return f.rock_kg; });
  if (regions.dipper) {
    column("in_dipper_kg", [](const rock::FrameSums& f) { return f.in_dipper_kg; });
    column("ahead_kg", [](const rock::FrameSums& f) { return f.ahead_kg; });
  }
  if (regions.truck) column("in_truck_kg", [](const rock::FrameSums& f) { return f.in_truck_kg; });
  if (!dumps.has_velocities()) return out;
  if (regions.dipper) {
    column("flow_kg", [](const rock::FrameSums& f) { return f.flow_kg; });
    column("bulk_kg", [](const rock::FrameSums& f) { return f.bulk_kg; });
    column("relative_speed_m_s", [](const rock::FrameSums& f) { return f.relative_speed_m_s(); });
  }
  column("kinetic_energy_J", [](const rock::FrameSums& f) { return f.kinetic_energy_J; });
  return out;
}

json pile_table(const PileSurface& before, const PileSurface* after) {
  const rock::SurfaceProfile& p = before.profile;
  json out = {{"x_m", p.x_m}, {"before_m", p.z_m}};
  if (after != nullptr) {
    double removed = 0;
    for (std::size_t i = 0; i < p.x_m.size(); ++i) {
      const double z = after->profile.x_m.empty() ? 0 : height_at(after->profile, p.x_m[i]);
      out["after_m"].push_back(z);
      removed += (p.z_m[i] - z) * p.step_m;
    }
    out["removed_m3_per_m"] = removed;
  }
  for (const auto& [name, surface] : {std::pair{"angle_before", &before}, {"angle_after", after}}) {
    if (surface == nullptr || !surface->angle) continue;
    out[std::string(name) + "_deg"] = surface->angle->angle_deg;
    out[std::string(name) + "_sigma_deg"] = surface->angle->sigma_deg;
  }
  return out;
}

json sizes_table(const run::RunData& run, const Survey& survey,
                 const std::vector<PassFacts>& passes) {
  json out = json::array();
  double all = 0;
  for (const auto& [type, c] : survey.classes) all += c.mass_kg;
  for (const auto& [type, c] : survey.classes) {
    json row = {{"class", type}};
    const std::string name = run.text(fmt::format("rock.classes.{}.name", type - 1));
    row["name"] = name.empty() ? fmt::format("type {}", type) : name;
    if (c.volume_m3 > 0)
      row["size_m"] = std::cbrt(6 / M_PI * c.volume_m3 / static_cast<double>(c.rocks));
    row["pile_percent"] = 100 * c.mass_kg / all;
    json& loaded = row["loaded_percent"] = json::array();
    for (const PassFacts& f : passes) {
      json& percent = loaded.emplace_back();
      if (!f.fate || f.fate->lifted_kg <= 0) continue;
      const auto at = f.fate->class_kg.find(type);
      percent = at == f.fate->class_kg.end() ? 0 : 100 * at->second / f.fate->lifted_kg;
    }
    out.push_back(row);
  }
  return out;
}

json walls_table(const std::vector<rock::WallField>& fields) {
  json out = json::array();
  for (const rock::WallField& f : fields) {
    double area = 0, sum = 0;
    for (std::size_t i = 0; i < f.last.size(); ++i) {
      area += f.area_m2[i];
      sum += f.area_m2[i] * f.last[i];
    }
    const auto [low, high] = std::minmax_element(f.last.begin(), f.last.end());
    if (low == f.last.end()) continue;
    out.push_back({{"body", f.body},
                   {"field", f.field},
                   {"time_s", f.time_s},
                   {"triangles", f.last.size()},
                   {"area_m2", area},
                   {"min", *low},
                   {"max", *high},
                   {"mean", area > 0 ? sum / area : 0},
                   {"max_over_time", *std::max_element(f.max.begin(), f.max.end())}});
  }
  return out;
}

}  // namespace dipper::analysis::metrics
