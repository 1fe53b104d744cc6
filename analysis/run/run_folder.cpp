#include "analysis/run/run_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/io/line_reader.hpp"
#include "analysis/io/vtk_file.hpp"
#include "common/csv_table.hpp"
#include "common/fines.hpp"
#include "common/json_text.hpp"
#include "common/json_values.hpp"
#include "common/manifest.hpp"
#include "common/mesh/mesh_check.hpp"
#include "common/mesh/stl.hpp"
#include "common/record/record.hpp"
#include "common/text_file.hpp"
#include "common/warn.hpp"

namespace dipper::analysis::run {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kRounding_s = 1e-6;

std::string bytes_of(const fs::path& file) {
  std::optional<std::string> bytes = read_bytes(file);
  if (!bytes) throw io::input_error(file, 0, "cannot be read; it belongs to a run's folder");
  return *std::move(bytes);
}

json json_of(const fs::path& file) {
  json j = parse_json_or_discard(bytes_of(file));
  if (!j.is_object()) throw io::input_error(file, 1, "not a JSON object: it was cut short");
  return j;
}

/// The regions the rock side has weighed in, and what the dipper holds. Runs made before there was
/// scales.json have the regions in its input, which its owner alone may read.
void read_scales(RunData& run) {
  const fs::path& folder = run.folder;
  rock::LoadRegions& regions = run.regions;
  const bool apart = fs::exists(folder / "scales.json");
  const fs::path file = apart ? folder / "scales.json" : folder / "logs" / "dem.json";
  const json setup = json_of(file);
  try {
    for (const json& s : apart ? setup.at("scales") : setup.at("settings").at("scales")) {
      const Box region{vector_from(s.at("min_m")), vector_from(s.at("max_m"))};
      run.masses.push_back(s.at("name"));
      if (run.is_shovel && s.at("name") == "mass_in_dipper") regions.dipper = region;
      if (s.at("name") != "mass_in_truck") continue;
      regions.truck = region;
      regions.X_WT = {quaternion_from(s.at("R_WS")), vector_from(s.at("p_WS"))};
    }
    run.struck_given_m3 =
        setup.value("struck_volume_m3", 0.0);  // 0: a run made before it was there
    if (regions.dipper) {
      regions.lip_x_m = setup.value("lip_x_m", regions.dipper->max_m.x());
      if (!setup.contains("lip_x_m"))
        warn(
            file.string() +
            ": has no lip_x_m, as the run is of an earlier version: the stages of its dig, and the "
            "rock ahead of the dipper, are those of a lip as far out as the heap");
    }
  } catch (const json::exception& e) {
    throw io::input_error(file, 0, e.what());
  }
}

/// What a report takes from summary.json has to be what a run writes.
json read_summary(const fs::path& file) {
  json summary = json_of(file);
  const json number = 0.0;
  if (!summary.value("status", json()).is_string() ||
      !summary.value("cpu_s_per_sim_s", number).is_number())
    throw io::input_error(file, 0, "status must be a string and cpu_s_per_sim_s a number");
  const json warnings = summary.value("warnings", json::array());
  if (!warnings.is_array() || !std::all_of(warnings.begin(), warnings.end(),
                                           [](const json& text) { return text.is_string(); }))
    throw io::input_error(file, 0, "warnings must be a list of strings");
  const json truck = summary.value("truck", json::object());  // outlives its items
  for (const auto& [key, value] : truck.items())
    if (!value.is_number()) throw io::input_error(file, 0, "truck." + key + " is a number");
  return summary;
}

/// A wall's mesh in its own frame from its first dump, for a run whose STL files are elsewhere.
mesh::TriangleMesh from_dump(const fs::path& file, const Pose& X_WB) {
  mesh::TriangleMesh mesh = io::read_wall_dump(io::index_vtk(file)).mesh;
  for (auto& v : mesh.vertices) v = inverse(X_WB) * v;
  return mesh;
}

void read_meshes(RunData& run) {
  std::vector<std::string> names = {"truck"};
  for (const auto& track : run.signals.walls) names.push_back(track.first);
  for (const std::string& name : names) {
    const fs::path built = run.folder / "deck" / "walls" / (name + ".stl");
    if (fs::exists(built)) {
      run.meshes[name] = mesh::read_stl(built);
      continue;
    }
    const fs::path dump = run.folder / "dumps" / (name + "_0.vtk");
    const auto track = run.signals.walls.find(name);
    const Pose X_WB =
        track == run.signals.walls.end() ? run.regions.X_WT : track->second.at(0).X_WB;
    if (fs::exists(dump)) run.meshes[name] = from_dump(dump, X_WB);
  }
}

/// Of the keys bodies.NAME.
std::vector<std::string> body_names(const CaseLines& lines) {
  const std::string section = "bodies.";
  std::vector<std::string> names;
  for (const CaseLine& line : lines)
    if (line.key.compare(0, section.size(), section) == 0)
      names.push_back(line.key.substr(section.size()));
  return names;
}

/// The dipper with its door where it is at the start: shut.
mesh::TriangleMesh vessel_of(const RunData& run) {
  mesh::TriangleMesh vessel = run.meshes.at("dipper");
  if (run.meshes.count("door") == 0) return vessel;
  const Pose X_BD =
      inverse(run.signals.walls.at("dipper").at(0).X_WB) * run.signals.walls.at("door").at(0).X_WB;
  const mesh::TriangleMesh& door = run.meshes.at("door");
  for (std::size_t t = 0; t < door.triangles.size(); ++t) {
    mesh::Triangle corners = door.corners(t);
    for (auto& c : corners) c = X_BD * c;
    vessel.add_loose(corners);
  }
  return vessel;
}

}  // namespace

double RunData::number(const std::string& key) const {
  if (const auto value = case_lines.number(key)) return *value;
  throw io::input_error(folder / "case.txt", 0, "has no number " + key);
}

Vector3d RunData::vector(const std::string& key) const {
  const CaseLine* line = case_lines.find(key);
  const json value = line == nullptr ? json() : parse_json_or_discard(line->value);
  if (!value.is_array() || value.size() != 3)
    throw io::input_error(folder / "case.txt", 0, "has no vector " + key);
  return vector_from(value);
}

std::string RunData::text(const std::string& key) const { return case_lines.text(key); }

RunData read_run_folder(const fs::path& folder) {
  RunData run;
  run.folder = folder;
  run.is_run = true;
  require_undamaged(folder);
  run.case_text = bytes_of(folder / "case.txt");
  run.case_lines = CaseLines(run.case_text);
  if (fs::exists(folder / "summary.json")) run.summary = read_summary(folder / "summary.json");
  const fs::path record = folder / "record.h5";
  run.is_shovel = run.text("machine.kind") != "poses";
  run.signals =
      run.is_shovel ? read_signals(record) : read_body_signals(record, body_names(run.case_lines));
  // A resumed run keeps the summary of its earlier end until it ends again.
  const double end_s = run.signals.pass.time_s.back();
  if (run.summary.is_object() && std::abs(run.summary.value("sim_s", end_s) - end_s) > kRounding_s)
    run.summary = nullptr;
  run.case_hash = record::read_attribute(record, "case_hash");
  run.version = record::read_attribute(record, "version");
  run.rock_version = record::read_attribute(record, "rock_version");
  run.machine_version = record::read_attribute(record, "machine_version");
  if (run.is_shovel) run.dipper = run.signals.walls.at("dipper");
  const double pile = run.number("rock.bulk_density_kg_m3"),
               rock = run.number("rock.density_kg_m3");
  run.bulk_density_kg_m3 =
      with_fines(pile, run.number("rock.fines_fraction"), std::max(0.0, 1 - pile / rock));
  read_scales(run);
  run.clumps = rock::read_clump_masses(folder / "deck" / "rocks.in");
  read_meshes(run);
  if (run.is_shovel && run.meshes.count("dipper") != 0) run.vessel = vessel_of(run);
  return run;
}

mesh::TriangleMesh read_sound_mesh(const fs::path& file) {
  mesh::TriangleMesh mesh = mesh::read_stl(file);
  if (const auto faults = mesh::check_mesh(mesh); !faults.empty())
    throw io::input_error(
        file, 0,
        fmt::format(
            "does not enclose a volume: {}{}", faults[0].message,
            faults.size() > 1 ? fmt::format(" (and {} more faults)", faults.size() - 1) : ""));
  return mesh;
}

RunData read_foreign_folder(const fs::path& folder, const std::optional<ForeignDipper>& dipper) {
  RunData run;
  run.folder = folder;
  if (!dipper) return run;
  run.meshes["dipper"] = run.vessel = read_sound_mesh(dipper->mesh);
  run.dipper = read_poses(dipper->poses);
  return run;
}

namespace {

constexpr double kFarthest = 1e6;  // m, s

}  // namespace

rock::PoseTrack read_poses(const fs::path& file) {
  std::vector<Finding> faults;
  std::vector<double> time_s;
  std::vector<Pose> X_WB;
  for (const CsvRow& row :
       read_csv(file, {"time_s", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}, faults)) {
    const auto& v = row.values;
    if (!time_s.empty() && v[0] <= time_s.back())
      faults.push_back({file, row.line, "", "time_s does not rise"});
    if (std::abs(v[0]) > kFarthest || Vector3d(v[1], v[2], v[3]).cwiseAbs().maxCoeff() > kFarthest)
      faults.push_back({file, row.line, "",
                        fmt::format("times and places lie between -{0:g} and {0:g}", kFarthest)});
    const Quaterniond R(v[4], v[5], v[6], v[7]);
    if (std::abs(R.norm() - 1) > 1e-3)
      faults.push_back(
          {file, row.line, "",
           fmt::format("qw ... qz is not a rotation: its length is {:.4g}, not 1", R.norm())});
    time_s.push_back(v[0]);
    X_WB.push_back({R.normalized(), {v[1], v[2], v[3]}});
  }
  if (faults.empty() && time_s.empty()) faults.push_back({file, 0, "", "no poses"});
  sort_by_line(faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  return {time_s, X_WB};
}

}  // namespace dipper::analysis::run
