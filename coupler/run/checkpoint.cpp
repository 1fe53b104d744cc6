#include "coupler/run/checkpoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "common/input_error.hpp"
#include "common/json_text.hpp"
#include "common/json_values.hpp"
#include "common/manifest.hpp"
#include "common/text_file.hpp"
#include "common/warn.hpp"

namespace dipper::run {
namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Checkpoint folders with that extension, oldest first; without an extension: the completed ones,
/// valid or damaged. Other folders are the user's.
std::vector<fs::path> list(const fs::path& checkpoints, const std::string& extension = "") {
  std::vector<fs::path> found;
  if (!fs::exists(checkpoints)) return found;
  for (const auto& entry : fs::directory_iterator(checkpoints)) {
    const std::string step = entry.path().stem().string();
    if (entry.is_directory() && entry.path().extension() == extension &&
        step.find_first_not_of("0123456789") == std::string::npos)
      found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Throws when there are checkpoints and all of them are damaged. The error lists those found now,
/// with the fault of each, and those set aside earlier.
void require_none_lost(const fs::path& checkpoints,
                       const std::vector<std::pair<fs::path, std::string>>& damaged) {
  std::vector<Finding> findings;
  for (const auto& [folder, damage] : damaged)
    findings.push_back({folder, 0, "", "no valid checkpoint: " + damage});
  for (const fs::path& aside : list(checkpoints, ".damaged")) {
    const std::string damage = damage_of(aside);
    findings.push_back({aside, 0, "",
                        damage.empty() ? "set aside, but valid: rename it to " +
                                             aside.stem().string() + " to continue from it"
                                       : "set aside as damaged: " + damage});
  }
  if (findings.empty()) return;
  findings.push_back({checkpoints, 0, "",
                      "no valid checkpoint is left to continue from; restore one from a "
                      "copy, or run the case again into another --out"});
  throw InputError(std::move(findings));
}

}  // namespace

Checkpoint save_checkpoint(const fs::path& checkpoints, Checkpoint c, core::Rock& rock,
                           core::Machine& machine) {
  const fs::path place = checkpoints / fmt::format("{:09d}", c.coupling.step_index);
  c.folder = place.string() + ".part";
  fs::remove_all(c.folder);
  fs::create_directories(c.folder);
  rock.save(c.rock());
  machine.save(c.machine());
  json held = json::array(), walls = json::array(), memory = json::array();
  for (const auto& F : c.coupling.held) held.push_back(json_of(F));
  for (const auto& wall : c.coupling.walls) {
    walls.push_back(json_of(wall.X_WB));
    memory.push_back({json_of(wall.load), json_of(wall.V_WB_W)});
  }
  const json coupling{{"step_index", c.coupling.step_index},
                      {"dem_step", c.coupling.dem_step},
                      {"held", held},
                      {"walls", walls},
                      {"memory", memory},
                      {"record_rows", c.record.rows},
                      {"record_t_ns", c.record.t_ns},
                      {"rock_work_J", c.record.rock_work_J},
                      {"machine_work_J", c.record.machine_work_J},
                      {"dem_cpu_s", c.cost.dem_cpu_s},
                      {"mbs_cpu_s", c.cost.mbs_cpu_s},
                      {"wall_s", c.cost.wall_s},
                      {"rock_busy_s", c.cost.rock_busy_s},
                      {"resends", c.cost.resends},
                      {"foreign_messages", c.cost.foreign_messages},
                      {"desk", c.desk}};
  write_text(c.folder / "coupling.json", coupling.dump(1));
  seal(c.folder);
  fs::remove_all(place);
  rename_sealed(c.folder, place);
  c.folder = place;
  const auto all = list(checkpoints);
  for (std::size_t i = 0; i + 2 < all.size(); ++i) {
    // The checkpoint at which a segment began stays: a replay of that segment needs it.
    const auto segment = fmt::format("events-{}.lcmlog", std::stoll(all[i].filename().string()));
    if (!fs::exists(checkpoints.parent_path() / segment)) fs::remove_all(all[i]);
  }
  return c;
}

std::optional<Checkpoint> last_checkpoint(const fs::path& checkpoints) {
  auto all = list(checkpoints);
  std::vector<std::pair<fs::path, std::string>> damaged;  // newest first
  for (; !all.empty(); all.pop_back()) {
    const std::string damage = damage_of(all.back());
    if (damage.empty()) break;
    damaged.emplace_back(all.back(), damage);
  }
  if (all.empty()) {
    require_none_lost(checkpoints, damaged);
    return std::nullopt;
  }
  for (const auto& [folder, damage] : damaged) {
    const fs::path aside = set_aside(folder);
    warn(fmt::format(
        "{}; this checkpoint is renamed to {}, the run continues from the previous one: {}", damage,
        aside.string(), all.back().string()));
  }
  const json j = read_json(all.back() / "coupling.json");
  Checkpoint c;
  c.folder = all.back();
  c.coupling.step_index = j.at("step_index");
  c.coupling.dem_step = j.at("dem_step");
  for (const auto& f : j.at("held")) c.coupling.held.push_back(wrench_from(f));
  for (std::size_t b = 0; b < j.at("walls").size(); ++b) {
    const auto& memory = j.at("memory").at(b);
    c.coupling.walls.push_back(
        {pose_from(j.at("walls").at(b)), twist_from(memory.at(1)), wrench_from(memory.at(0))});
  }
  c.record = {j.at("record_rows"), j.at("record_t_ns"), j.at("rock_work_J"),
              j.at("machine_work_J")};
  c.cost = {j.at("dem_cpu_s"),   j.at("mbs_cpu_s"),      j.at("wall_s"),
            j.at("rock_busy_s"), j.value("resends", 0L), j.value("foreign_messages", 0L)};
  c.desk = j.value("desk", json());  // earlier checkpoints have no numbers of messages, and no desk
  return c;
}

}  // namespace dipper::run
