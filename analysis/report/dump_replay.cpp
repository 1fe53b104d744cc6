#include "analysis/report/dump_replay.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "analysis/vtk_file.hpp"
#include "coupler/record/record.hpp"

namespace dipper {
namespace {

/// Recorded poses and twists of a body, and the row for a time.
class RecordedBody {
 public:
  RecordedBody(const std::filesystem::path& record, const std::string& body)
      : time_(read_channel(record, "time_s")) {
    for (std::size_t k = 0; k < 7; ++k) {
      pose_[k] = read_channel(record, "bodies/" + body + "/pose", k);
    }
    for (std::size_t k = 0; k < 6; ++k) {
      twist_[k] = read_channel(record, "bodies/" + body + "/twist", k);
    }
  }
  bool empty() const { return time_.empty(); }

  /// The last row at or before a time; sync steps are a small part of a frame.
  BodyState at(double time_s) const {
    const auto after = std::upper_bound(time_.begin(), time_.end(), time_s + 1e-9);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - time_.begin() - 1, 0));
    const auto p = [&](std::size_t k) { return pose_[k][i]; };
    const auto v = [&](std::size_t k) { return twist_[k][i]; };
    BodyState s;
    s.X_WB.p = {p(0), p(1), p(2)};
    s.X_WB.R = Quaterniond(p(3), p(4), p(5), p(6)).normalized();
    s.V_WB_W.w = {v(0), v(1), v(2)};
    s.V_WB_W.v = {v(3), v(4), v(5)};
    return s;
  }

 private:
  std::vector<double> time_;
  std::array<std::vector<double>, 7> pose_;
  std::array<std::vector<double>, 6> twist_;
};

const std::array<std::string, 2> kDriven{"dipper", "door"};

}  // namespace

std::vector<MovingWall> walls_of_run(const std::filesystem::path& record, const DumpFolder& dumps) {
  std::vector<MovingWall> walls;
  for (const auto& [name, steps] : dumps.walls) {
    if (steps.empty()) continue;
    const auto& [step, file] = *steps.begin();
    MovingWall wall{{name, read_wall_dump(index_vtk(file)).mesh},
                    [](double) { return BodyState{}; }};
    if (std::find(kDriven.begin(), kDriven.end(), name) != kDriven.end()) {
      const auto body = std::make_shared<RecordedBody>(record, name);
      if (body->empty()) continue;
      const Pose X_BW = inverse(body->at(static_cast<double>(step) * dumps.timestep_s).X_WB);
      for (auto& vertex : wall.wall.mesh.vertices) vertex = X_BW * vertex;
      wall.state = [body](double t) { return body->at(t); };
    }
    walls.push_back(std::move(wall));
  }
  return walls;
}

DumpReplay::DumpReplay(const DumpFolder& dumps, std::vector<MovingWall> walls) : dumps_(dumps) {
  for (auto& w : walls) {
    walls_.push_back(std::move(w.wall));
    states_.push_back(std::move(w.state));
  }
}

void DumpReplay::read(std::size_t index, ReplayFrame& frame) const {
  const DumpFrame& dump = dumps_.frames.at(index);
  std::vector<std::string> columns = {"id", "x", "y", "z", "radius"};
  const auto optional = [&](const char* name) -> std::size_t {
    if (!dump.has(name)) return 0;  // the place of "id", which none of them is
    columns.emplace_back(name);
    return columns.size() - 1;
  };
  const std::size_t type = optional("type"), rock = optional("id_multisphere");
  const std::array<std::size_t, 3> v = {optional("vx"), optional("vy"), optional("vz")};

  frame.time_s = dumps_.time_s.at(index);
  frame.spheres.clear();
  frame.spheres.reserve(dump.particles);
  DumpReader::read(dump, columns, [&](const ParticleChunk& chunk) {
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
      frame.spheres.push_back(s);
    }
  });
  frame.walls.clear();
  for (const auto& state : states_) frame.walls.push_back(state(frame.time_s));
}

}  // namespace dipper
