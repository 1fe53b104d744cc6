#include "analysis/report/record_replay.hpp"

#include <algorithm>

#include "common/csv_table.hpp"
#include "common/input_error.hpp"
#include "common/mesh/stl.hpp"

namespace dipper::analysis::report {
namespace {

constexpr double kEvery_s = 0.2;

/// A section (x, z in W) extruded over the pile's width, with its two sides.
mesh::TriangleMesh extruded(const std::vector<CsvRow>& section, double width_m) {
  mesh::TriangleMesh mesh;
  const double y = width_m / 2;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    const auto &a = section[i].values, &b = section[i + 1].values;
    const auto at = [](const std::vector<double>& p, double side) {
      return Vector3d(p[0], side, p[1]);
    };
    const auto foot = [](const std::vector<double>& p, double side) {
      return Vector3d(p[0], side, 0);
    };
    mesh.add_loose({at(a, -y), at(b, -y), at(b, y)});
    mesh.add_loose({at(a, -y), at(b, y), at(a, y)});
    for (const double side : {-y, y}) {
      mesh.add_loose({foot(a, side), foot(b, side), at(b, side)});
      mesh.add_loose({foot(a, side), at(b, side), at(a, side)});
    }
  }
  return mesh;
}

mesh::TriangleMesh bench_of(const run::RunData& run) {
  const auto surface = run.folder / "deck" / "surface.stl";
  if (std::filesystem::exists(surface)) return mesh::read_stl(surface);
  std::vector<Finding> faults;
  const auto section = read_csv(run.folder / "deck" / "outline.csv", {"x_m", "z_m"}, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
  return extruded(section, run.number("pile.width_m"));
}

}  // namespace

RecordReplay::RecordReplay(const run::RunData& run) {
  for (MovingWall& w : replay_walls(run)) {
    walls_.push_back(std::move(w.wall));
    states_.push_back(std::move(w.state));
  }
  walls_.push_back({"bench", bench_of(run)});
  states_.emplace_back([](double) { return BodyState{}; });
  const double end_s = run.signals.pass.time_s.back();
  for (int k = 0; k * kEvery_s < end_s; ++k) times_s_.push_back(k * kEvery_s);
  times_s_.push_back(end_s);
}

void RecordReplay::read(std::size_t index, ReplayFrame& frame, const Keep&) const {
  frame.time_s = times_s_.at(index);
  frame.spheres.clear();
  frame.walls.clear();
  for (const auto& state : states_) frame.walls.push_back(state(frame.time_s));
  frame.values.assign(walls_.size(), {});
}

}  // namespace dipper::analysis::report
