#include "analysis/report/dump_replay.hpp"

#include <fmt/format.h>

#include <array>

#include "analysis/io/line_reader.hpp"
#include "analysis/rock/wall_fields.hpp"

namespace dipper::analysis::report {

std::vector<MovingWall> replay_walls(const run::RunData& run) {
  std::vector<MovingWall> walls;
  for (const auto& [name, mesh] : run.meshes) {
    const auto recorded = run.signals.walls.find(name);
    if (recorded != run.signals.walls.end()) {
      walls.push_back(
          {{name, mesh}, [&track = recorded->second](double t) { return track.at(t); }});
    } else if (name == "dipper" && !run.dipper.empty()) {
      walls.push_back({{name, mesh}, [&track = run.dipper](double t) { return track.at(t); }});
    } else if (name == "truck") {
      walls.push_back({{name, mesh}, [X_WT = run.regions.X_WT](double) {
                         return BodyState{X_WT, {}};
                       }});
    }
  }
  return walls;
}

DumpReplay::DumpReplay(const io::DumpFolder& dumps, std::vector<MovingWall> walls) : dumps_(dumps) {
  for (auto& w : walls) {
    const auto found = dumps.walls.find(w.wall.name);
    if (found != dumps.walls.end() && !found->second.empty()) {
      const rock::WallFrame first = rock::read_wall_frame(found->second.begin()->second);
      const bool same = first.mesh.triangles.size() == w.wall.mesh.triangles.size();
      for (const auto& [name, values] : first.fields)
        if (same) w.wall.fields.push_back(name);
    }
    walls_.push_back(std::move(w.wall));
    states_.push_back(std::move(w.state));
  }
}

void DumpReplay::read_walls(std::int64_t step, ReplayFrame& frame) const {
  frame.walls.clear();
  frame.values.clear();
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    frame.walls.push_back(states_[w](frame.time_s));
    auto& values = frame.values.emplace_back();
    if (walls_[w].fields.empty()) continue;
    const auto& file = dumps_.walls.at(walls_[w].name).at(step);
    rock::WallFrame dump = rock::read_wall_frame(file);
    for (const std::string& field : walls_[w].fields) {
      const std::vector<double>& all = dump.fields[field];
      if (all.size() != walls_[w].mesh.triangles.size())
        throw io::input_error(
            file, dump.line[field],
            fmt::format("{} has {} for {} triangles, the wall has {}", walls_[w].name, field,
                        all.size(), walls_[w].mesh.triangles.size()));
      values.emplace_back(all.begin(), all.end());
    }
  }
}

void DumpReplay::read(std::size_t index, ReplayFrame& frame, const Keep& keep) const {
  const io::DumpFrame& dump = dumps_.frames.at(index);
  std::vector<std::string> columns = {"id", "x", "y", "z", "radius"};
  const auto optional = [&](const char* name) -> std::size_t {
    if (!dump.has(name)) return 0;  // the index of "id", which no field has
    columns.emplace_back(name);
    return columns.size() - 1;
  };
  const std::size_t type = optional("type"), rock = optional("id_multisphere");
  const std::array<std::size_t, 3> v = {optional("vx"), optional("vy"), optional("vz")};

  frame.time_s = dumps_.time_s.at(index);
  read_walls(dump.step, frame);
  frame.spheres.clear();
  io::DumpReader::read(dump, columns, [&](const io::ParticleChunk& chunk) {
    for (std::size_t i = 0; i < chunk.rows; ++i) {
      const auto value = [&](std::size_t column) { return chunk.columns[column][i]; };
      ReplaySphere s;
      s.id = static_cast<std::int64_t>(value(0));
      s.p_m = {static_cast<float>(value(1)), static_cast<float>(value(2)),
               static_cast<float>(value(3))};
      s.radius_m = static_cast<float>(value(4));
      if (type) s.type = static_cast<int>(value(type));
      if (rock) s.rock = static_cast<std::int64_t>(value(rock));
      for (int k = 0; k < 3; ++k) {
        const std::size_t column = v[static_cast<std::size_t>(k)];
        if (column) s.v_m_s[k] = static_cast<float>(value(column));
      }
      if (keep(s)) frame.spheres.push_back(s);
    }
  });
}

}  // namespace dipper::analysis::report
